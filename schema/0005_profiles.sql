-- Search profiles. Every put is a new row: its number is the revision, and AUTOINCREMENT
-- never gives one again, not even to another profile of the same name.
--
-- weights: a JSON array of 3 channels (the order of the colour space) of 6 integers (bins 0
-- to 5). The constraint sees the shape; profile_store.cc checks on reading that each of the
-- 18 is a 32-bit integer.

CREATE TABLE profiles (
    revision      INTEGER PRIMARY KEY AUTOINCREMENT,
    name          TEXT    NOT NULL UNIQUE,
    color_space   TEXT    NOT NULL,
    decomposition TEXT    NOT NULL,
    m             INTEGER NOT NULL,
    bin_rule      TEXT    NOT NULL,
    weights       TEXT    NOT NULL,
    intercept     REAL,
    scale         REAL,
    updated_at    TEXT    NOT NULL,
    CONSTRAINT name_is_a_word CHECK (
        length(name) BETWEEN 1 AND 64 AND name NOT GLOB '*[^a-z0-9_-]*'),
    CONSTRAINT color_space_is_a_word CHECK (length(color_space) BETWEEN 1 AND 64),
    CONSTRAINT decomposition_is_a_word CHECK (length(decomposition) BETWEEN 1 AND 64),
    CONSTRAINT m_is_a_count CHECK (m BETWEEN 1 AND 2147483647),
    CONSTRAINT bin_rule_is_a_word CHECK (length(bin_rule) BETWEEN 1 AND 64),
    CONSTRAINT weights_are_3_by_6 CHECK (
        CASE WHEN json_valid(weights) THEN
            json_array_length(weights) = 3
            AND json_array_length(weights, '$[0]') = 6
            AND json_array_length(weights, '$[1]') = 6
            AND json_array_length(weights, '$[2]') = 6
        ELSE 0 END),
    CONSTRAINT calibration_is_whole CHECK ((intercept IS NULL) = (scale IS NULL)),
    CONSTRAINT calibration_is_finite CHECK (
        coalesce(abs(intercept) < 9e999 AND abs(scale) < 9e999, 1))
) STRICT;
