-- Pairs of pictures that look the same, in generations: one is shown while the next is made.

CREATE TABLE duplicate_generations (
    generation INTEGER PRIMARY KEY AUTOINCREMENT,
    published  INTEGER NOT NULL,
    created_at TEXT    NOT NULL,
    CONSTRAINT published_is_a_flag CHECK (published IN (0, 1))
) STRICT;

-- The one that is shown.
CREATE UNIQUE INDEX duplicate_generations_published
ON duplicate_generations (published) WHERE published = 1;

CREATE TABLE duplicates (
    generation INTEGER NOT NULL
               REFERENCES duplicate_generations (generation) ON DELETE CASCADE,
    a          INTEGER NOT NULL REFERENCES images (id) ON DELETE CASCADE,
    b          INTEGER NOT NULL REFERENCES images (id) ON DELETE CASCADE,
    level      TEXT    NOT NULL,
    similarity REAL    NOT NULL,
    PRIMARY KEY (generation, a, b),
    CONSTRAINT a_is_below_b CHECK (a < b),
    CONSTRAINT level_is_a_word CHECK (length(level) BETWEEN 1 AND 64),
    CONSTRAINT similarity_is_finite CHECK (abs(similarity) < 9e999)
) STRICT, WITHOUT ROWID;

-- For the deletion of a picture.
CREATE INDEX duplicates_a ON duplicates (a);
CREATE INDEX duplicates_b ON duplicates (b);

-- "These two are no duplicates": kept as long as both pictures.
CREATE TABLE ignored_duplicates (
    a          INTEGER NOT NULL REFERENCES images (id) ON DELETE CASCADE,
    b          INTEGER NOT NULL REFERENCES images (id) ON DELETE CASCADE,
    created_at TEXT    NOT NULL,
    PRIMARY KEY (a, b),
    CONSTRAINT a_is_below_b CHECK (a < b)
) STRICT, WITHOUT ROWID;

CREATE INDEX ignored_duplicates_b ON ignored_duplicates (b);

-- A row that stays without its picture (failed, deleted) has no duplicates either.
CREATE TRIGGER duplicates_go_with_the_signature AFTER UPDATE OF state ON images
WHEN OLD.state = 'indexed' AND NEW.state <> 'indexed'
BEGIN
    DELETE FROM duplicates WHERE a = NEW.id;
    DELETE FROM duplicates WHERE b = NEW.id;
END;

-- Pictures whose files are the same byte by byte stand side by side.
CREATE INDEX images_content ON images (content_hash)
WHERE state = 'indexed' AND content_hash <> '';
