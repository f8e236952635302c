-- Where a job goes on after a finished stage; dropped when it ends.
CREATE TABLE checkpoints (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  stage TEXT NOT NULL,
  size INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  encoding TEXT NOT NULL CHECK (encoding IN ('raw', 'zstd')),
  bytes BLOB NOT NULL,
  PRIMARY KEY (job_id, position),
  UNIQUE (job_id, stage)
);

-- As in 0003, now from the end of the stage that made them and compressed. size and sha256 are of the
-- plain bytes. The bytes come last: lists need not step over them.
CREATE TABLE new_results (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  kind TEXT NOT NULL CHECK (kind IN ('file', 'time', 'cycle', 'summary')),
  name TEXT NOT NULL,
  stage TEXT NOT NULL,
  size INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  encoding TEXT NOT NULL CHECK (encoding IN ('raw', 'zstd')),
  bytes BLOB NOT NULL,
  PRIMARY KEY (job_id, kind, name)
);

INSERT INTO new_results (job_id, kind, name, stage, size, sha256, encoding, bytes)
SELECT job_id, kind, name, '', size, sha256, 'raw', bytes FROM results;

DROP TABLE results;
ALTER TABLE new_results RENAME TO results;
