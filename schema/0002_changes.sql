-- The change sequence: which pictures became findable, changed or went, in commit order.
--
-- Triggers write it, so that no writer can forget to. SQLite has one writer at a time and
-- holds its lock until the commit: a number is handed out only after every smaller one is
-- visible or rolled back, and AUTOINCREMENT never hands out a committed number again.

CREATE TABLE changes (
    seq      INTEGER PRIMARY KEY AUTOINCREMENT,
    image_id INTEGER NOT NULL UNIQUE
) STRICT;

INSERT INTO changes (image_id) SELECT id FROM images ORDER BY id;

CREATE TRIGGER image_appears AFTER INSERT ON images
WHEN NEW.state = 'indexed'
BEGIN
    INSERT INTO changes (image_id) VALUES (NEW.id);
END;

-- A stamp alone changes nothing that a search can see.
CREATE TRIGGER image_changes AFTER UPDATE OF state, signature, width, height ON images
WHEN OLD.state IS NOT NEW.state
  OR OLD.signature IS NOT NEW.signature
  OR OLD.width IS NOT NEW.width
  OR OLD.height IS NOT NEW.height
BEGIN
    DELETE FROM changes WHERE image_id = NEW.id;
    INSERT INTO changes (image_id) VALUES (NEW.id);
END;

CREATE TRIGGER image_disappears AFTER DELETE ON images
BEGIN
    DELETE FROM changes WHERE image_id = OLD.id;
    INSERT INTO changes (image_id) VALUES (OLD.id);
END;
