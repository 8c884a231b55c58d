-- The words of a picture: of its uri, its tags and the string values of its metadata.
--
-- Triggers keep them, so that no writer can forget to. A row belongs to every searchable
-- picture and to no other. The text is stored beside its index: an index alone could only be
-- undone by a writer that still knows every word it once put in.
--
-- haarmony_words() is the program's own function (uri_words.h). U+E000 counts as a letter
-- and stands between tags and between values, so that no phrase runs from one into the next.

CREATE VIRTUAL TABLE image_text USING fts5 (
    uri, tags, metadata, tokenize = "unicode61 remove_diacritics 2");

CREATE VIEW image_words AS
SELECT id,
       haarmony_words(uri) AS uri,
       (SELECT group_concat(tag, ' ' || char(57344) || ' ')
        FROM image_tags WHERE image_id = images.id) AS tags,
       (SELECT group_concat(atom, ' ' || char(57344) || ' ')
        FROM json_tree(images.metadata) WHERE type = 'text') AS metadata
FROM images
WHERE state = 'indexed';

INSERT INTO image_text (rowid, uri, tags, metadata)
SELECT id, uri, tags, metadata FROM image_words ORDER BY id;

CREATE TRIGGER text_appears AFTER INSERT ON images
WHEN NEW.state = 'indexed'
BEGIN
    INSERT INTO image_text (rowid, uri, tags, metadata)
    SELECT id, uri, tags, metadata FROM image_words WHERE id = NEW.id;
END;

CREATE TRIGGER text_changes AFTER UPDATE OF state, uri, metadata ON images
WHEN OLD.state IS NOT NEW.state
  OR OLD.uri IS NOT NEW.uri
  OR OLD.metadata IS NOT NEW.metadata
BEGIN
    DELETE FROM image_text WHERE rowid = OLD.id;
    INSERT INTO image_text (rowid, uri, tags, metadata)
    SELECT id, uri, tags, metadata FROM image_words WHERE id = NEW.id;
END;

-- Before: the tags go with their picture, and would each be taken out of the text.
CREATE TRIGGER text_disappears BEFORE DELETE ON images
BEGIN
    DELETE FROM image_text WHERE rowid = OLD.id;
END;

CREATE TRIGGER tag_appears AFTER INSERT ON image_tags
BEGIN
    UPDATE image_text
    SET tags = (SELECT group_concat(tag, ' ' || char(57344) || ' ')
                FROM image_tags WHERE image_id = NEW.image_id)
    WHERE rowid = NEW.image_id;
END;

CREATE TRIGGER tag_changes AFTER UPDATE ON image_tags
BEGIN
    UPDATE image_text
    SET tags = (SELECT group_concat(tag, ' ' || char(57344) || ' ')
                FROM image_tags WHERE image_id = image_text.rowid)
    WHERE rowid IN (OLD.image_id, NEW.image_id);
END;

CREATE TRIGGER tag_disappears AFTER DELETE ON image_tags
BEGIN
    UPDATE image_text
    SET tags = (SELECT group_concat(tag, ' ' || char(57344) || ' ')
                FROM image_tags WHERE image_id = OLD.image_id)
    WHERE rowid = OLD.image_id;
END;
