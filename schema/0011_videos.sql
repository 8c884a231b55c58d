-- Multiresolution videos. What they show is in files beside the database
-- (schema/README.md); a row is there once its file is, and the file goes after its row.
--
-- revision: of the file's content, sixteen hexadecimal digits: equal clips, equal revisions.

CREATE TABLE videos (
    id                INTEGER PRIMARY KEY AUTOINCREMENT,
    revision          TEXT    NOT NULL,
    name              TEXT    NOT NULL,
    width             INTEGER NOT NULL,
    height            INTEGER NOT NULL,
    frames            INTEGER NOT NULL,
    rate_numerator    INTEGER NOT NULL,
    rate_denominator  INTEGER NOT NULL,
    delta             REAL    NOT NULL,
    time_nodes        INTEGER NOT NULL,
    complete_subtrees INTEGER NOT NULL,
    pruned_subtrees   INTEGER NOT NULL,
    own_subtrees      INTEGER NOT NULL,
    uplinks           INTEGER NOT NULL,
    memory_bytes      INTEGER NOT NULL,
    disk_bytes        INTEGER NOT NULL,
    indexed           INTEGER NOT NULL,
    job_id            INTEGER,
    created_at        TEXT    NOT NULL,
    CONSTRAINT revision_is_hexadecimal CHECK (
        length(revision) = 16 AND revision NOT GLOB '*[^0-9a-f]*'),
    CONSTRAINT name_is_short CHECK (length(name) <= 256),
    CONSTRAINT shape_is_positive CHECK (width >= 1 AND height >= 1 AND frames >= 1),
    CONSTRAINT rate_is_positive CHECK (rate_numerator >= 1 AND rate_denominator >= 1),
    CONSTRAINT delta_is_not_negative CHECK (delta >= 0),
    CONSTRAINT counts_are_not_negative CHECK (
        time_nodes >= 0 AND complete_subtrees >= 0 AND pruned_subtrees >= 0
        AND own_subtrees >= 0 AND uplinks >= 0 AND memory_bytes >= 0 AND disk_bytes >= 0),
    CONSTRAINT indexed_is_a_bool CHECK (indexed IN (0, 1))
) STRICT;

-- A job that is taken up again finds what it has made already. Jobs are forgotten in time,
-- so this is no reference.
CREATE UNIQUE INDEX videos_job ON videos (job_id) WHERE job_id IS NOT NULL;

-- What searches inside videos find: time nodes, of single frames and of longer stretches.
-- An id is never given twice, so that a search array in memory can follow.
CREATE TABLE frame_signatures (
    id         INTEGER PRIMARY KEY AUTOINCREMENT,
    video_id   INTEGER NOT NULL REFERENCES videos (id) ON DELETE CASCADE,
    time_level INTEGER NOT NULL,
    node       INTEGER NOT NULL,
    shot       INTEGER NOT NULL,
    signature  BLOB    NOT NULL,
    UNIQUE (video_id, time_level, node),
    CONSTRAINT place_is_not_negative CHECK (time_level >= 0 AND node >= 0 AND shot >= 0),
    CONSTRAINT signature_is_not_empty CHECK (length(signature) > 0)
) STRICT;
