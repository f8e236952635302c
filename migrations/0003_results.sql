-- What a succeeded job produced. kind: 'file' (bytes to download), 'time' and 'cycle' (tables in the
-- project's binary form), 'summary' (JSON).
CREATE TABLE results (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  kind TEXT NOT NULL CHECK (kind IN ('file', 'time', 'cycle', 'summary')),
  name TEXT NOT NULL,
  size INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  bytes BLOB NOT NULL,
  PRIMARY KEY (job_id, kind, name)
);
