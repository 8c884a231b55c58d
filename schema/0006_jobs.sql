-- Long-running jobs: what was asked for, how far it is, what came of it.

CREATE TABLE jobs (
    id               INTEGER PRIMARY KEY AUTOINCREMENT,
    type             TEXT    NOT NULL,
    request          TEXT    NOT NULL,
    state            TEXT    NOT NULL,
    cancel_requested INTEGER NOT NULL,
    seen             INTEGER NOT NULL,
    added            INTEGER NOT NULL,
    updated          INTEGER NOT NULL,
    skipped          INTEGER NOT NULL,
    failed           INTEGER NOT NULL,
    total            INTEGER NOT NULL,
    position         TEXT    NOT NULL,
    result           TEXT    NOT NULL,
    created_at       TEXT    NOT NULL,
    started_at       TEXT    NOT NULL,
    finished_at      TEXT    NOT NULL,
    CONSTRAINT type_is_a_word CHECK (length(type) BETWEEN 1 AND 64),
    CONSTRAINT request_is_a_json_object CHECK (
        CASE WHEN json_valid(request) THEN json_type(request) = 'object' ELSE 0 END),
    CONSTRAINT state_is_known CHECK (
        state IN ('queued', 'running', 'done', 'failed', 'cancelled')),
    CONSTRAINT cancel_is_asked_of_a_running_job CHECK (
        cancel_requested = 0 OR (cancel_requested = 1 AND state = 'running')),
    CONSTRAINT counts_are_not_negative CHECK (
        seen >= 0 AND added >= 0 AND updated >= 0 AND skipped >= 0 AND failed >= 0),
    CONSTRAINT total_is_a_count_or_unknown CHECK (total >= -1),
    CONSTRAINT result_is_a_json_object CHECK (
        CASE WHEN json_valid(result) THEN json_type(result) = 'object' ELSE 0 END),
    CONSTRAINT running_has_started CHECK (state <> 'running' OR started_at <> ''),
    CONSTRAINT finished_has_a_time CHECK (
        (state IN ('done', 'failed', 'cancelled')) = (finished_at <> ''))
) STRICT;

CREATE INDEX jobs_state ON jobs (state);

-- Which of the finished ones finished last.
CREATE INDEX jobs_finished ON jobs (finished_at, id) WHERE finished_at <> '';

CREATE TABLE job_errors (
    job_id  INTEGER NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    number  INTEGER NOT NULL,
    message TEXT    NOT NULL,
    PRIMARY KEY (job_id, number)
) STRICT, WITHOUT ROWID;
