-- Curves that were given a name: characters, whose details others can take, and strokes that
-- drawn ones are compared with. Every put is a new row: its number is the revision, and
-- AUTOINCREMENT never gives one again.
--
-- numbers: rows of `dimension` doubles, eight bytes each, least significant first; the control
-- points of a character, the samples of a stroke.

CREATE TABLE curves (
    revision   INTEGER PRIMARY KEY AUTOINCREMENT,
    kind       TEXT    NOT NULL,
    name       TEXT    NOT NULL,
    closed     INTEGER NOT NULL,
    dimension  INTEGER NOT NULL,
    numbers    BLOB    NOT NULL,
    updated_at TEXT    NOT NULL,
    UNIQUE (kind, name),
    CONSTRAINT kind_is_known CHECK (kind IN ('character', 'stroke')),
    CONSTRAINT name_is_a_word CHECK (
        length(name) BETWEEN 1 AND 64 AND name NOT GLOB '*[^a-z0-9_-]*'),
    CONSTRAINT closed_is_a_bool CHECK (closed IN (0, 1)),
    CONSTRAINT dimension_is_a_count CHECK (dimension BETWEEN 1 AND 8),
    CONSTRAINT numbers_are_rows CHECK (
        length(numbers) > 0 AND length(numbers) % (8 * dimension) = 0)
) STRICT;
