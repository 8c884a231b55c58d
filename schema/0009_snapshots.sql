-- Which files with a snapshot of the search arrays belong to this database. A file holds the
-- token of its row, and is believed only where the row is found.
--
-- Random, and not the number of a change: a copy of the database that is put back gives the
-- numbers that came after it again, to other changes. A row is written after the changes that
-- its file holds, so that whatever copy has the row has these changes, too.

CREATE TABLE snapshots (
    number     INTEGER PRIMARY KEY AUTOINCREMENT,
    token      BLOB    NOT NULL UNIQUE,
    seq        INTEGER NOT NULL,
    created_at TEXT    NOT NULL,
    CONSTRAINT token_is_16_bytes CHECK (length(token) = 16),
    CONSTRAINT seq_is_a_number CHECK (seq >= 0)
) STRICT;
