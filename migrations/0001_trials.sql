-- Uploaded bytes, stored once however often they are uploaded.
CREATE TABLE blobs (
  sha256 TEXT PRIMARY KEY,
  size INTEGER NOT NULL,
  bytes BLOB NOT NULL
) WITHOUT ROWID;

-- One measured movement of one subject. Times are milliseconds since 1970 UTC.
CREATE TABLE trials (
  id TEXT PRIMARY KEY,
  created_at INTEGER NOT NULL,
  mass_kg REAL NOT NULL,
  height_m REAL NOT NULL,
  marker_set TEXT,
  options TEXT NOT NULL,
  understood TEXT NOT NULL,
  warnings TEXT NOT NULL
) WITHOUT ROWID;

CREATE TABLE trial_files (
  trial_id TEXT NOT NULL REFERENCES trials (id) ON DELETE CASCADE,
  part TEXT NOT NULL,
  name TEXT NOT NULL,
  sha256 TEXT NOT NULL REFERENCES blobs (sha256),
  PRIMARY KEY (trial_id, part)
) WITHOUT ROWID;

CREATE INDEX trial_files_by_blob ON trial_files (sha256);
