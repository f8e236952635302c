-- Jobs submitted as one. `changed` moves when one of its jobs is deleted.
CREATE TABLE studies (
  id TEXT PRIMARY KEY,
  tenant TEXT NOT NULL,
  key_id TEXT NOT NULL,
  name TEXT NOT NULL,
  label TEXT NOT NULL,
  created_at INTEGER NOT NULL,
  changed INTEGER NOT NULL DEFAULT 0,
  submission_key TEXT NOT NULL DEFAULT ''
) WITHOUT ROWID;

CREATE INDEX studies_by_tenant ON studies (tenant, id);
CREATE INDEX studies_by_label ON studies (tenant, label, id) WHERE label <> '';
CREATE UNIQUE INDEX studies_by_submission ON studies (tenant, submission_key)
WHERE submission_key <> '';

-- A running job is its owner's until lease_until [ms since 1970 UTC]. 0 means that nobody holds it:
-- given back, or its owner has been found dead. `version` counts the changes that the user sees and
-- is the id of the job's last event; `changed` is the number of its last change among all jobs.
ALTER TABLE jobs ADD COLUMN tenant TEXT NOT NULL DEFAULT 'local';
ALTER TABLE jobs ADD COLUMN key_id TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN study_id TEXT REFERENCES studies (id);
ALTER TABLE jobs ADD COLUMN model_id TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN label TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN subject TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN owner TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN lease_until INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN version INTEGER NOT NULL DEFAULT 1;
ALTER TABLE jobs ADD COLUMN changed INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN verdict TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN provenance TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN last_death TEXT;
ALTER TABLE jobs ADD COLUMN frames INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN pixels INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN submission_key TEXT NOT NULL DEFAULT '';

-- A table of their own: a poll reads the job's row without stepping over its settings.
CREATE TABLE job_settings (
  job_id TEXT PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
  document TEXT NOT NULL
) WITHOUT ROWID;

INSERT INTO job_settings (job_id, document) SELECT id, settings FROM jobs;
ALTER TABLE jobs DROP COLUMN settings;

CREATE INDEX jobs_by_tenant ON jobs (tenant, id);
CREATE INDEX jobs_by_tenant_state ON jobs (tenant, state, id);
CREATE INDEX jobs_by_subject ON jobs (tenant, subject, id) WHERE subject <> '';
CREATE INDEX jobs_by_label ON jobs (tenant, label, id) WHERE label <> '';
CREATE INDEX jobs_by_study ON jobs (study_id, id) WHERE study_id IS NOT NULL;
CREATE INDEX jobs_by_model ON jobs (model_id) WHERE model_id <> '';
CREATE INDEX jobs_by_change ON jobs (changed);
CREATE INDEX jobs_by_end ON jobs (finished_at) WHERE finished_at IS NOT NULL;
CREATE UNIQUE INDEX jobs_by_submission ON jobs (tenant, submission_key) WHERE submission_key <> '';

CREATE TABLE job_events (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  id INTEGER NOT NULL,
  at INTEGER NOT NULL,
  kind TEXT NOT NULL CHECK (kind IN ('state', 'stage', 'progress', 'warning')),
  data TEXT NOT NULL,
  PRIMARY KEY (job_id, id)
) WITHOUT ROWID;

INSERT INTO job_events (job_id, id, at, kind, data)
SELECT id, 1, coalesce(finished_at, started_at, submitted_at), 'state',
  '{"state":"' || state || '"}' FROM jobs;

-- Warnings of a stage that has not finished are forgotten when the job is claimed again.
ALTER TABLE job_warnings ADD COLUMN settled INTEGER NOT NULL DEFAULT 0;
UPDATE job_warnings SET settled = 1;
