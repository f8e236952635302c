-- Who owns what. What was stored before there were keys belongs to the local user.
CREATE TABLE api_keys (
  id TEXT PRIMARY KEY,
  tenant TEXT NOT NULL,
  name TEXT NOT NULL,
  scopes TEXT NOT NULL,
  secret_sha256 TEXT NOT NULL UNIQUE,
  created_at INTEGER NOT NULL,
  revoked_at INTEGER NOT NULL DEFAULT 0
) WITHOUT ROWID;

CREATE INDEX api_keys_by_tenant ON api_keys (tenant, id);

-- Numbers that only grow. 'jobs': the last change of any job; 'keys': of any key.
CREATE TABLE counters (
  name TEXT PRIMARY KEY,
  value INTEGER NOT NULL
) WITHOUT ROWID;

INSERT INTO counters (name, value) VALUES ('jobs', 0), ('keys', 0);

ALTER TABLE trials ADD COLUMN tenant TEXT NOT NULL DEFAULT 'local';
ALTER TABLE trials ADD COLUMN key_id TEXT NOT NULL DEFAULT '';
ALTER TABLE trials ADD COLUMN subject TEXT NOT NULL DEFAULT '';
ALTER TABLE trials ADD COLUMN label TEXT NOT NULL DEFAULT '';
ALTER TABLE trials ADD COLUMN bytes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE trials ADD COLUMN submission_key TEXT NOT NULL DEFAULT '';

-- `understood` was the list of files; now it is everything understood, warnings included.
UPDATE trials SET
  understood = '{"files":' || understood || ',"events":[],"warnings":' || warnings || '}',
  bytes = (
    SELECT coalesce(sum(size), 0) FROM trial_files JOIN blobs ON blobs.id = blob_id
    WHERE trial_id = trials.id);
ALTER TABLE trials DROP COLUMN warnings;

-- Ids sort by time, so every list is a range of one of these.
CREATE INDEX trials_by_tenant ON trials (tenant, id);
CREATE INDEX trials_by_subject ON trials (tenant, subject, id) WHERE subject <> '';
CREATE INDEX trials_by_label ON trials (tenant, label, id) WHERE label <> '';
CREATE UNIQUE INDEX trials_by_submission ON trials (tenant, submission_key)
WHERE submission_key <> '';

-- Uploaded models and marker sets; the shipped ones are files.
CREATE TABLE catalog (
  id TEXT PRIMARY KEY,
  tenant TEXT NOT NULL,
  key_id TEXT NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('model', 'marker_set')),
  name TEXT NOT NULL,
  created_at INTEGER NOT NULL,
  summary TEXT NOT NULL,
  blob_id INTEGER NOT NULL REFERENCES blobs (id),
  submission_key TEXT NOT NULL DEFAULT ''
) WITHOUT ROWID;

CREATE INDEX catalog_by_tenant ON catalog (tenant, kind, id);
CREATE INDEX catalog_by_blob ON catalog (blob_id);
CREATE UNIQUE INDEX catalog_by_submission ON catalog (tenant, submission_key)
WHERE submission_key <> '';
CREATE INDEX trials_by_marker_set ON trials (marker_set, tenant) WHERE marker_set IS NOT NULL;

-- What each key has stored at present.
CREATE TABLE usage (
  tenant TEXT NOT NULL,
  key_id TEXT NOT NULL,
  bytes INTEGER NOT NULL DEFAULT 0,
  trials INTEGER NOT NULL DEFAULT 0,
  jobs INTEGER NOT NULL DEFAULT 0,
  frames INTEGER NOT NULL DEFAULT 0,
  pixels INTEGER NOT NULL DEFAULT 0,
  PRIMARY KEY (tenant, key_id)
) WITHOUT ROWID;

INSERT INTO usage (tenant, key_id, bytes, trials, jobs)
SELECT 'local', '', coalesce(sum(bytes), 0), count(*), (SELECT count(*) FROM jobs) FROM trials;

-- First answers to requests that named a key, for a day.
CREATE TABLE idempotency (
  tenant TEXT NOT NULL,
  key TEXT NOT NULL,
  owner TEXT NOT NULL,
  created_at INTEGER NOT NULL,
  request_hash TEXT NOT NULL,
  status INTEGER NOT NULL,
  content_type TEXT NOT NULL,
  location TEXT NOT NULL,
  body TEXT NOT NULL,
  PRIMARY KEY (tenant, key)
) WITHOUT ROWID;

CREATE INDEX idempotency_by_time ON idempotency (created_at);
