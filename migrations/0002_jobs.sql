-- One run of the pipeline on a trial. `claim` counts the attempts and fences them: whoever writes
-- about a running job names the claim it holds, and a stale one changes nothing. `deaths` counts the
-- attempts that ended with the process.
CREATE TABLE jobs (
  id TEXT PRIMARY KEY,
  trial_id TEXT NOT NULL REFERENCES trials (id),
  settings_name TEXT NOT NULL,
  settings TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('queued', 'running', 'succeeded', 'failed', 'cancelled')),
  claim INTEGER NOT NULL DEFAULT 0,
  deaths INTEGER NOT NULL DEFAULT 0,
  cancel_requested INTEGER NOT NULL DEFAULT 0,
  submitted_at INTEGER NOT NULL,
  started_at INTEGER,
  finished_at INTEGER,
  error TEXT
) WITHOUT ROWID;

-- Ids sort by time, so the oldest queued job is the first row of this index.
CREATE INDEX jobs_by_state ON jobs (state, id);
CREATE INDEX jobs_by_trial ON jobs (trial_id);

-- Stages of the last attempt in the order they began; seconds by the wall clock.
CREATE TABLE job_stages (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  stage TEXT NOT NULL,
  seconds REAL NOT NULL,
  fraction REAL NOT NULL,
  PRIMARY KEY (job_id, position)
) WITHOUT ROWID;

CREATE TABLE job_warnings (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  message TEXT NOT NULL,
  PRIMARY KEY (job_id, position)
) WITHOUT ROWID;
