-- Uploaded bytes in pieces of at most 1 MiB, each compressed on its own, so that a large file streams
-- through. `uses` counts the rows that refer to a blob; 0 is an upload that has not ended or a blob
-- being deleted. Ids are never used again, so that a reader of a deleted blob finds nothing.
CREATE TABLE new_blobs (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  sha256 TEXT NOT NULL,
  size INTEGER NOT NULL,
  uses INTEGER NOT NULL
);

-- size and sha256 are of the plain bytes [begins, begins + size).
CREATE TABLE blob_chunks (
  blob_id INTEGER NOT NULL REFERENCES new_blobs (id) ON DELETE CASCADE,
  begins INTEGER NOT NULL,
  size INTEGER NOT NULL,
  encoding TEXT NOT NULL CHECK (encoding IN ('raw', 'zstd')),
  sha256 TEXT NOT NULL,
  bytes BLOB NOT NULL,
  PRIMARY KEY (blob_id, begins)
);

CREATE TABLE new_trial_files (
  trial_id TEXT NOT NULL REFERENCES trials (id) ON DELETE CASCADE,
  part TEXT NOT NULL,
  name TEXT NOT NULL,
  blob_id INTEGER NOT NULL REFERENCES new_blobs (id),
  PRIMARY KEY (trial_id, part)
) WITHOUT ROWID;

INSERT INTO new_blobs (sha256, size, uses)
SELECT sha256, size, (SELECT count(*) FROM trial_files WHERE trial_files.sha256 = blobs.sha256)
FROM blobs ORDER BY sha256;

INSERT INTO blob_chunks (blob_id, begins, size, encoding, sha256, bytes)
SELECT new_blobs.id, 0, new_blobs.size, 'raw', new_blobs.sha256, blobs.bytes
FROM new_blobs JOIN blobs USING (sha256) WHERE new_blobs.size > 0;

INSERT INTO new_trial_files (trial_id, part, name, blob_id)
SELECT trial_id, part, name, new_blobs.id FROM trial_files JOIN new_blobs USING (sha256);

DROP TABLE trial_files;
DROP TABLE blobs;
ALTER TABLE new_blobs RENAME TO blobs;
ALTER TABLE new_trial_files RENAME TO trial_files;

CREATE UNIQUE INDEX blobs_by_content ON blobs (sha256) WHERE uses > 0;
CREATE INDEX blobs_unused ON blobs (id) WHERE uses = 0;
CREATE INDEX trial_files_by_blob ON trial_files (blob_id);
