-- Pictures: one row each, their thumbnails, their tags.
--
-- Signature before metadata: a long metadata text then spills to overflow pages behind the
-- signature, and a scan of all signatures never follows them.

CREATE TABLE images (
    id              INTEGER PRIMARY KEY AUTOINCREMENT,
    origin          TEXT    NOT NULL,
    state           TEXT    NOT NULL,
    uri             TEXT    NOT NULL,
    size            INTEGER NOT NULL,
    mtime_ns        INTEGER NOT NULL,
    content_hash    TEXT    NOT NULL,
    width           INTEGER NOT NULL,
    height          INTEGER NOT NULL,
    media_type      TEXT    NOT NULL,
    low_information INTEGER NOT NULL,
    signature       BLOB,
    failure         TEXT    NOT NULL,
    added_at        TEXT    NOT NULL,
    updated_at      TEXT    NOT NULL,
    revision        INTEGER NOT NULL,
    metadata        TEXT    NOT NULL,
    CONSTRAINT origin_is_known CHECK (origin IN ('upload', 'file')),
    CONSTRAINT state_is_known CHECK (state IN ('indexed', 'failed', 'deleted')),
    CONSTRAINT size_is_not_negative CHECK (size >= 0),
    CONSTRAINT width_is_a_count CHECK (width BETWEEN 0 AND 2147483647),
    CONSTRAINT height_is_a_count CHECK (height BETWEEN 0 AND 2147483647),
    CONSTRAINT low_information_is_a_flag CHECK (low_information IN (0, 1)),
    CONSTRAINT signature_where_indexed CHECK ((state = 'indexed') = (signature IS NOT NULL)),
    CONSTRAINT signature_is_not_empty CHECK (length(signature) > 0),
    CONSTRAINT reason_where_failed CHECK ((state = 'failed') = (failure <> '')),
    CONSTRAINT metadata_is_a_json_object CHECK (
        CASE WHEN json_valid(metadata) THEN json_type(metadata) = 'object' ELSE 0 END)
) STRICT;

-- A path is one row; uploads may repeat a uri or have none.
CREATE UNIQUE INDEX images_file_uri ON images (uri) WHERE origin = 'file';

-- Counting by state and listing what is searchable without reading the rows.
CREATE INDEX images_state ON images (state);

CREATE TABLE thumbnails (
    image_id   INTEGER PRIMARY KEY REFERENCES images (id) ON DELETE CASCADE,
    media_type TEXT    NOT NULL,
    bytes      BLOB    NOT NULL,
    CONSTRAINT thumbnail_has_a_type CHECK (media_type <> '')
) STRICT;

CREATE TABLE image_tags (
    image_id INTEGER NOT NULL REFERENCES images (id) ON DELETE CASCADE,
    tag      TEXT    NOT NULL,
    PRIMARY KEY (image_id, tag)
) STRICT, WITHOUT ROWID;

CREATE INDEX image_tags_tag ON image_tags (tag, image_id);
