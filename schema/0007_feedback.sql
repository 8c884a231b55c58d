-- Training pairs: a query that somebody drew or scanned, and the picture meant by it.

CREATE TABLE feedback (
    id         INTEGER PRIMARY KEY AUTOINCREMENT,
    kind       TEXT    NOT NULL,
    target     INTEGER NOT NULL REFERENCES images (id) ON DELETE CASCADE,
    signature  BLOB,
    strokes    TEXT,
    seconds    REAL,
    created_at TEXT    NOT NULL,
    CONSTRAINT kind_is_a_word CHECK (length(kind) BETWEEN 1 AND 64),
    CONSTRAINT query_is_there CHECK (signature IS NOT NULL OR strokes IS NOT NULL),
    CONSTRAINT signature_is_not_empty CHECK (length(signature) > 0),
    CONSTRAINT strokes_are_json CHECK (strokes IS NULL OR json_valid(strokes)),
    CONSTRAINT seconds_are_a_time CHECK (seconds >= 0 AND seconds < 9e999)
) STRICT;

CREATE INDEX feedback_kind ON feedback (kind, id);

-- For the deletion of a picture.
CREATE INDEX feedback_target ON feedback (target);
