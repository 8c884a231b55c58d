-- Further signatures of a picture, beside images.signature: of other colour spaces, other
-- crops. A follower must learn of them as it learns of the first one.
--
-- Clustered by picture: a scan of all pictures reads them beside it, in the same order.

CREATE TABLE image_signatures (
    image_id  INTEGER NOT NULL REFERENCES images (id) ON DELETE CASCADE,
    variant   TEXT    NOT NULL,
    signature BLOB    NOT NULL,
    PRIMARY KEY (image_id, variant),
    CONSTRAINT variant_has_a_name CHECK (length(variant) BETWEEN 1 AND 64),
    CONSTRAINT variant_is_not_empty CHECK (length(signature) > 0)
) STRICT, WITHOUT ROWID;

-- Which pictures have a variant, and how many, without reading the signatures.
CREATE INDEX image_signatures_variant ON image_signatures (variant, image_id);

CREATE TRIGGER variant_needs_a_searchable_image BEFORE INSERT ON image_signatures
WHEN NOT EXISTS (SELECT 1 FROM images WHERE id = NEW.image_id AND state = 'indexed')
BEGIN
    SELECT RAISE(ABORT, 'variant_needs_a_searchable_image');
END;

-- A row belongs to its picture and variant for good.
CREATE TRIGGER variant_stays_with_its_image
BEFORE UPDATE OF image_id, variant ON image_signatures
WHEN OLD.image_id IS NOT NEW.image_id OR OLD.variant IS NOT NEW.variant
BEGIN
    SELECT RAISE(ABORT, 'variant_stays_with_its_image');
END;

CREATE TRIGGER variant_appears AFTER INSERT ON image_signatures
BEGIN
    DELETE FROM changes WHERE image_id = NEW.image_id;
    INSERT INTO changes (image_id) VALUES (NEW.image_id);
END;

CREATE TRIGGER variant_changes AFTER UPDATE OF signature ON image_signatures
WHEN OLD.signature IS NOT NEW.signature
BEGIN
    DELETE FROM changes WHERE image_id = NEW.image_id;
    INSERT INTO changes (image_id) VALUES (NEW.image_id);
END;

-- Of a picture that is gone, or not searchable any more, the triggers on images tell.
CREATE TRIGGER variant_disappears AFTER DELETE ON image_signatures
WHEN EXISTS (SELECT 1 FROM images WHERE id = OLD.image_id AND state = 'indexed')
BEGIN
    DELETE FROM changes WHERE image_id = OLD.image_id;
    INSERT INTO changes (image_id) VALUES (OLD.image_id);
END;

CREATE TRIGGER variants_go_with_the_first_signature AFTER UPDATE OF state ON images
WHEN OLD.state = 'indexed' AND NEW.state <> 'indexed'
BEGIN
    DELETE FROM image_signatures WHERE image_id = NEW.id;
END;
