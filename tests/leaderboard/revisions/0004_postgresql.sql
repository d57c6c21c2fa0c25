CREATE FUNCTION colift_append_only() RETURNS trigger
    LANGUAGE plpgsql
    AS $$
BEGIN RAISE EXCEPTION '% is append-only', TG_TABLE_NAME; END;
$$;
CREATE TABLE alembic_version (
    version_num character varying(32) NOT NULL
);
CREATE TABLE entries (
    number integer NOT NULL,
    season character varying(40) NOT NULL,
    submission character varying(64) NOT NULL,
    name text NOT NULL,
    submitter text NOT NULL,
    at timestamp with time zone NOT NULL,
    "row" json,
    refusal text
);
CREATE SEQUENCE entries_number_seq
    AS integer
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;
ALTER SEQUENCE entries_number_seq OWNED BY entries.number;
CREATE TABLE events (
    number integer NOT NULL,
    at timestamp with time zone NOT NULL,
    who text NOT NULL,
    kind text NOT NULL,
    why text NOT NULL,
    season character varying(40) NOT NULL,
    submission character varying(64),
    content json
);
CREATE SEQUENCE events_number_seq
    AS integer
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;
ALTER SEQUENCE events_number_seq OWNED BY events.number;
CREATE TABLE hidden_errors (
    number integer NOT NULL,
    season character varying(40) NOT NULL,
    submission character varying(64) NOT NULL,
    rmse_mm bytea NOT NULL
);
CREATE SEQUENCE hidden_errors_number_seq
    AS integer
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;
ALTER SEQUENCE hidden_errors_number_seq OWNED BY hidden_errors.number;
CREATE TABLE jobs (
    id character varying(32) NOT NULL,
    season character varying(40) NOT NULL,
    submission character varying(64) NOT NULL,
    name text NOT NULL,
    submitter text NOT NULL,
    state text NOT NULL,
    stage text,
    done integer NOT NULL,
    total integer NOT NULL,
    submitted_at timestamp with time zone NOT NULL,
    started_at timestamp with time zone,
    heartbeat_at timestamp with time zone,
    ended_at timestamp with time zone,
    ready_at timestamp with time zone NOT NULL,
    worker text,
    attempt integer NOT NULL,
    faults integer NOT NULL,
    lost integer NOT NULL,
    reason text,
    size integer DEFAULT 0 NOT NULL
);
CREATE TABLE rank_groups (
    season character varying(40) NOT NULL,
    fingerprint character varying(64) NOT NULL,
    groups json NOT NULL
);
CREATE TABLE seasons (
    number integer NOT NULL,
    name character varying(40) NOT NULL,
    suite text NOT NULL,
    suite_digest text NOT NULL,
    commitment character varying(64) NOT NULL,
    began_at timestamp with time zone NOT NULL,
    taking boolean NOT NULL
);
CREATE SEQUENCE seasons_number_seq
    AS integer
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;
ALTER SEQUENCE seasons_number_seq OWNED BY seasons.number;
CREATE TABLE tokens (
    number integer NOT NULL,
    name text NOT NULL,
    sha256 character varying(64) NOT NULL,
    added_at timestamp with time zone NOT NULL,
    revoked_at timestamp with time zone
);
CREATE SEQUENCE tokens_number_seq
    AS integer
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;
ALTER SEQUENCE tokens_number_seq OWNED BY tokens.number;
CREATE TABLE workers (
    name text NOT NULL,
    seen_at timestamp with time zone NOT NULL,
    ended boolean NOT NULL
);
ALTER TABLE ONLY entries ALTER COLUMN number SET DEFAULT nextval('entries_number_seq'::regclass);
ALTER TABLE ONLY events ALTER COLUMN number SET DEFAULT nextval('events_number_seq'::regclass);
ALTER TABLE ONLY hidden_errors ALTER COLUMN number SET DEFAULT nextval('hidden_errors_number_seq'::regclass);
ALTER TABLE ONLY seasons ALTER COLUMN number SET DEFAULT nextval('seasons_number_seq'::regclass);
ALTER TABLE ONLY tokens ALTER COLUMN number SET DEFAULT nextval('tokens_number_seq'::regclass);
INSERT INTO alembic_version VALUES ('0004');
INSERT INTO entries VALUES (1, '1', '6d696e656d696e656d696e656d696e656d696e656d696e656d696e656d696e65', 'mine', 'Ada', '2026-11-20 08:30:00+00', '{"season": "1", "commitment": "cccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccc", "suite": "quick-v1", "suite_digest": "ssssssssssssssss", "name": "mine", "authors": ["Ada Lovelace", "Grace H\u00f6pper"], "description": "Lifts.", "link": "", "licence": "MIT", "trained_on": "nothing", "submission": "6d696e656d696e656d696e656d696e656d696e656d696e656d696e656d696e65", "public": {"episodes": 12, "failed": 0, "rmse_mm": {"mean": 10.0, "ci95": [9.0, 11.0]}, "vs_human": {"mean": 1.0, "ci95": [0.9, 1.1]}, "metrics": {"sparc": {"mean": -1.9, "missing": 0}, "human_force_n": {"mean": 0.3, "missing": 0}}, "step_ms_p50": 0.2, "step_ms_p99": 0.5, "real_time": true}, "hidden": {"episodes": 12, "failed": 0, "failures": {}, "rmse_mm": {"mean": 10.0, "ci95": [9.0, 11.0]}, "vs_human": {"mean": 1.0, "ci95": [0.9, 1.1]}, "real_time": true, "better_than_human": 0.5}, "gap": {"mean": 1.02, "ci95": [0.9, 1.15]}, "isolation": "bubblewrap", "verified": true, "scoring": 1, "versions": {"colift": "0.1.0"}}', NULL);
INSERT INTO entries VALUES (2, '1', '796f757273796f757273796f757273796f757273796f757273796f757273796f', 'yours', 'Ada', '2026-11-20 08:30:00+00', '{"season": "1", "commitment": "cccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccc", "suite": "quick-v1", "suite_digest": "ssssssssssssssss", "name": "yours", "authors": ["Ada Lovelace", "Grace H\u00f6pper"], "description": "Lifts.", "link": "", "licence": "MIT", "trained_on": "nothing", "submission": "796f757273796f757273796f757273796f757273796f757273796f757273796f", "public": {"episodes": 12, "failed": 0, "rmse_mm": {"mean": 12.5, "ci95": [11.5, 13.5]}, "vs_human": {"mean": 1.25, "ci95": [1.15, 1.35]}, "metrics": {"sparc": {"mean": -1.9, "missing": 0}, "human_force_n": {"mean": 0.3, "missing": 0}}, "step_ms_p50": 0.2, "step_ms_p99": 0.5, "real_time": true}, "hidden": {"episodes": 12, "failed": 0, "failures": {}, "rmse_mm": {"mean": 12.5, "ci95": [11.5, 13.5]}, "vs_human": {"mean": 1.25, "ci95": [1.15, 1.35]}, "real_time": true, "better_than_human": 0.5}, "gap": {"mean": 1.02, "ci95": [0.9, 1.15]}, "isolation": "bubblewrap", "verified": true, "scoring": 1, "versions": {"colift": "0.1.0"}}', NULL);
INSERT INTO events VALUES (1, '2026-11-20 08:30:00+00', 'local', 'season', 'begun', '1', NULL, '{"commitment": "adcb13e4a30ef0c1363399551626fdecacbf96c868cccb5efe1a094858628113"}');
INSERT INTO events VALUES (2, '2026-11-20 08:30:00+00', 'local', 'removal', 'a mistake', '1', '796f757273796f757273796f757273796f757273796f757273796f757273796f', NULL);
INSERT INTO hidden_errors VALUES (1, '1', '6d696e656d696e656d696e656d696e656d696e656d696e656d696e656d696e65', '\x05a1d8e94f1324404683e76cb5eb23401c907b715e622440e68227d71c102440877b889fb8ad23409123017f8a3724409cb0405e4bc8244089fb21bd78912440b74c2a01e893234079b8639aa13d23409b2ed4d943a02340eadced0059062440');
INSERT INTO hidden_errors VALUES (2, '1', '796f757273796f757273796f757273796f757273796f757273796f757273796f', '\x05a1d8e94f1329404683e76cb5eb28401c907b715e622940e68227d71c102940877b889fb8ad28409123017f8a3729409cb0405e4bc8294089fb21bd78912940b74c2a01e893284079b8639aa13d28409b2ed4d943a02840eadced0059062940');
INSERT INTO jobs VALUES ('445186180ba84ca2b673f25935f7cbff', '1', '7682d1ebda2b31857c65bc01bd9dd4d26e0789c7b55a6fa4928e750b38088cb8', 'second', 'ada', 'queued', NULL, 0, 68, '2026-11-26 11:35:31.097457+00', NULL, NULL, NULL, '2026-11-26 11:35:31.097457+00', NULL, 0, 0, 0, NULL, 2105);
INSERT INTO jobs VALUES ('ccbcd00529ac468daceaebdd5d7f3c44', '1', 'bc17b0e85f5359b5c1d00b3585f6b4ed2cb43841e84fc7e7ab0ba55ec13fa398', 'first', 'ada', 'running', 'public run', 3, 68, '2026-11-26 11:35:31.021032+00', '2026-11-26 11:35:31.111262+00', '2026-11-26 11:35:31.131464+00', NULL, '2026-11-26 11:35:31.021032+00', 'host/machine/12/34', 1, 0, 0, NULL, 2104);
INSERT INTO rank_groups VALUES ('1', '0bac46368adccbe9939a4bb05b30bf537e5cc868aef9f6df7bf6257cfe995528', '[[1, [["6d696e656d696e656d696e656d696e656d696e656d696e656d696e656d696e65"]]]]');
INSERT INTO seasons VALUES (1, '1', 'quick-v1', 'a00e950194ab1919', 'adcb13e4a30ef0c1363399551626fdecacbf96c868cccb5efe1a094858628113', '2026-11-20 08:30:00+00', true);
INSERT INTO tokens VALUES (1, 'ada', 'ae8a29f344c61b56c8463e2f2573c4b8e08d6855fd1387ad5968bec63d04777c', '2026-11-20 08:30:00+00', NULL);
INSERT INTO workers VALUES ('host/machine/12/34', '2026-11-26 11:35:31.111262+00', false);
SELECT pg_catalog.setval('entries_number_seq', 2, true);
SELECT pg_catalog.setval('events_number_seq', 2, true);
SELECT pg_catalog.setval('hidden_errors_number_seq', 2, true);
SELECT pg_catalog.setval('seasons_number_seq', 1, true);
SELECT pg_catalog.setval('tokens_number_seq', 1, true);
ALTER TABLE ONLY alembic_version
    ADD CONSTRAINT alembic_version_pkc PRIMARY KEY (version_num);
ALTER TABLE ONLY entries
    ADD CONSTRAINT entries_pkey PRIMARY KEY (number);
ALTER TABLE ONLY entries
    ADD CONSTRAINT entries_season_submission_key UNIQUE (season, submission);
ALTER TABLE ONLY events
    ADD CONSTRAINT events_pkey PRIMARY KEY (number);
ALTER TABLE ONLY hidden_errors
    ADD CONSTRAINT hidden_errors_pkey PRIMARY KEY (number);
ALTER TABLE ONLY jobs
    ADD CONSTRAINT jobs_pkey PRIMARY KEY (id);
ALTER TABLE ONLY jobs
    ADD CONSTRAINT jobs_season_submission_key UNIQUE (season, submission);
ALTER TABLE ONLY rank_groups
    ADD CONSTRAINT rank_groups_pkey PRIMARY KEY (season, fingerprint);
ALTER TABLE ONLY seasons
    ADD CONSTRAINT seasons_name_key UNIQUE (name);
ALTER TABLE ONLY seasons
    ADD CONSTRAINT seasons_pkey PRIMARY KEY (number);
ALTER TABLE ONLY tokens
    ADD CONSTRAINT tokens_pkey PRIMARY KEY (number);
ALTER TABLE ONLY tokens
    ADD CONSTRAINT tokens_sha256_key UNIQUE (sha256);
ALTER TABLE ONLY workers
    ADD CONSTRAINT workers_pkey PRIMARY KEY (name);
CREATE INDEX ix_entries_name ON entries USING btree (name);
CREATE INDEX ix_events_of ON events USING btree (season, submission);
CREATE INDEX ix_hidden_errors_of ON hidden_errors USING btree (season, submission);
CREATE INDEX ix_jobs_state ON jobs USING btree (state);
CREATE INDEX ix_jobs_submitter ON jobs USING btree (submitter);
CREATE TRIGGER entries_append_only BEFORE DELETE OR UPDATE OR TRUNCATE ON entries FOR EACH STATEMENT EXECUTE FUNCTION colift_append_only();
CREATE TRIGGER events_append_only BEFORE DELETE OR UPDATE OR TRUNCATE ON events FOR EACH STATEMENT EXECUTE FUNCTION colift_append_only();
CREATE TRIGGER hidden_errors_append_only BEFORE DELETE OR UPDATE OR TRUNCATE ON hidden_errors FOR EACH STATEMENT EXECUTE FUNCTION colift_append_only();
CREATE TRIGGER seasons_append_only BEFORE DELETE OR UPDATE OR TRUNCATE ON seasons FOR EACH STATEMENT EXECUTE FUNCTION colift_append_only();
ALTER TABLE ONLY entries
    ADD CONSTRAINT entries_season_fkey FOREIGN KEY (season) REFERENCES seasons(name);
ALTER TABLE ONLY events
    ADD CONSTRAINT events_season_fkey FOREIGN KEY (season) REFERENCES seasons(name);
ALTER TABLE ONLY hidden_errors
    ADD CONSTRAINT hidden_errors_season_fkey FOREIGN KEY (season) REFERENCES seasons(name);
ALTER TABLE ONLY jobs
    ADD CONSTRAINT jobs_season_fkey FOREIGN KEY (season) REFERENCES seasons(name);
ALTER TABLE ONLY rank_groups
    ADD CONSTRAINT rank_groups_season_fkey FOREIGN KEY (season) REFERENCES seasons(name);
