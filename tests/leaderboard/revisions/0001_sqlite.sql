BEGIN TRANSACTION;
CREATE TABLE alembic_version (
	version_num VARCHAR(32) NOT NULL, 
	CONSTRAINT alembic_version_pkc PRIMARY KEY (version_num)
);
INSERT INTO "alembic_version" VALUES('0001');
CREATE TABLE entries (
	number INTEGER NOT NULL, 
	season VARCHAR(40) NOT NULL, 
	submission VARCHAR(64) NOT NULL, 
	name TEXT NOT NULL, 
	submitter TEXT NOT NULL, 
	at DATETIME NOT NULL, 
	"row" JSON, 
	refusal TEXT, 
	PRIMARY KEY (number), 
	UNIQUE (season, submission), 
	FOREIGN KEY(season) REFERENCES seasons (name)
);
INSERT INTO "entries" VALUES(1,'1','6d696e656d696e656d696e656d696e656d696e656d696e656d696e656d696e65','mine','Ada','2026-11-20 08:30:00.000000','{"season": "1", "commitment": "cccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccc", "suite": "quick-v1", "suite_digest": "ssssssssssssssss", "name": "mine", "authors": ["Ada Lovelace", "Grace H\u00f6pper"], "description": "Lifts.", "link": "", "licence": "MIT", "trained_on": "nothing", "submission": "6d696e656d696e656d696e656d696e656d696e656d696e656d696e656d696e65", "public": {"episodes": 12, "failed": 0, "rmse_mm": {"mean": 10.0, "ci95": [9.0, 11.0]}, "vs_human": {"mean": 1.0, "ci95": [0.9, 1.1]}, "metrics": {"sparc": {"mean": -1.9, "missing": 0}, "human_force_n": {"mean": 0.3, "missing": 0}}, "step_ms_p50": 0.2, "step_ms_p99": 0.5, "real_time": true}, "hidden": {"episodes": 12, "failed": 0, "failures": {}, "rmse_mm": {"mean": 10.0, "ci95": [9.0, 11.0]}, "vs_human": {"mean": 1.0, "ci95": [0.9, 1.1]}, "real_time": true, "better_than_human": 0.5}, "gap": {"mean": 1.02, "ci95": [0.9, 1.15]}, "isolation": "bubblewrap", "verified": true, "scoring": 1, "versions": {"colift": "0.1.0"}}',NULL);
INSERT INTO "entries" VALUES(2,'1','796f757273796f757273796f757273796f757273796f757273796f757273796f','yours','Ada','2026-11-20 08:30:00.000000','{"season": "1", "commitment": "cccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccccc", "suite": "quick-v1", "suite_digest": "ssssssssssssssss", "name": "yours", "authors": ["Ada Lovelace", "Grace H\u00f6pper"], "description": "Lifts.", "link": "", "licence": "MIT", "trained_on": "nothing", "submission": "796f757273796f757273796f757273796f757273796f757273796f757273796f", "public": {"episodes": 12, "failed": 0, "rmse_mm": {"mean": 12.5, "ci95": [11.5, 13.5]}, "vs_human": {"mean": 1.25, "ci95": [1.15, 1.35]}, "metrics": {"sparc": {"mean": -1.9, "missing": 0}, "human_force_n": {"mean": 0.3, "missing": 0}}, "step_ms_p50": 0.2, "step_ms_p99": 0.5, "real_time": true}, "hidden": {"episodes": 12, "failed": 0, "failures": {}, "rmse_mm": {"mean": 12.5, "ci95": [11.5, 13.5]}, "vs_human": {"mean": 1.25, "ci95": [1.15, 1.35]}, "real_time": true, "better_than_human": 0.5}, "gap": {"mean": 1.02, "ci95": [0.9, 1.15]}, "isolation": "bubblewrap", "verified": true, "scoring": 1, "versions": {"colift": "0.1.0"}}',NULL);
CREATE TABLE events (
	number INTEGER NOT NULL, 
	at DATETIME NOT NULL, 
	who TEXT NOT NULL, 
	kind TEXT NOT NULL, 
	why TEXT NOT NULL, 
	season VARCHAR(40) NOT NULL, 
	submission VARCHAR(64), 
	content JSON, 
	PRIMARY KEY (number), 
	FOREIGN KEY(season) REFERENCES seasons (name)
);
INSERT INTO "events" VALUES(1,'2026-11-20 08:30:00.000000','local','season','begun','1',NULL,'{"commitment": "46eed9d5b9f316d5bbd41674f6257a91e64787ab760cbda8b05cc96269512994"}');
INSERT INTO "events" VALUES(2,'2026-11-20 08:30:00.000000','local','removal','a mistake','1','796f757273796f757273796f757273796f757273796f757273796f757273796f',NULL);
CREATE TABLE hidden_errors (
	number INTEGER NOT NULL, 
	season VARCHAR(40) NOT NULL, 
	submission VARCHAR(64) NOT NULL, 
	rmse_mm BLOB NOT NULL, 
	PRIMARY KEY (number), 
	FOREIGN KEY(season) REFERENCES seasons (name)
);
INSERT INTO "hidden_errors" VALUES(1,'1','6d696e656d696e656d696e656d696e656d696e656d696e656d696e656d696e65',X'05A1D8E94F1324404683E76CB5EB23401C907B715E622440E68227D71C102440877B889FB8AD23409123017F8A3724409CB0405E4BC8244089FB21BD78912440B74C2A01E893234079B8639AA13D23409B2ED4D943A02340EADCED0059062440');
INSERT INTO "hidden_errors" VALUES(2,'1','796f757273796f757273796f757273796f757273796f757273796f757273796f',X'05A1D8E94F1329404683E76CB5EB28401C907B715E622940E68227D71C102940877B889FB8AD28409123017F8A3729409CB0405E4BC8294089FB21BD78912940B74C2A01E893284079B8639AA13D28409B2ED4D943A02840EADCED0059062940');
CREATE TABLE jobs (
	id VARCHAR(32) NOT NULL, 
	season VARCHAR(40) NOT NULL, 
	submission VARCHAR(64) NOT NULL, 
	name TEXT NOT NULL, 
	submitter TEXT NOT NULL, 
	state TEXT NOT NULL, 
	stage TEXT, 
	done INTEGER NOT NULL, 
	total INTEGER NOT NULL, 
	submitted_at DATETIME NOT NULL, 
	started_at DATETIME, 
	heartbeat_at DATETIME, 
	ended_at DATETIME, 
	ready_at DATETIME NOT NULL, 
	worker TEXT, 
	attempt INTEGER NOT NULL, 
	faults INTEGER NOT NULL, 
	lost INTEGER NOT NULL, 
	reason TEXT, 
	size INTEGER DEFAULT '0' NOT NULL, 
	PRIMARY KEY (id), 
	UNIQUE (season, submission), 
	FOREIGN KEY(season) REFERENCES seasons (name)
);
INSERT INTO "jobs" VALUES('11111111111111111111111111111111','1','bc17b0e85f5359b5c1d00b3585f6b4ed2cb43841e84fc7e7ab0ba55ec13fa398','first','ada','running','public run',3,68,'2026-11-20 08:30:00.000000','2026-11-20 08:30:00.000000','2026-11-20 08:30:00.000000',NULL,'2026-11-20 08:30:00.000000','host/machine/12/34',1,0,0,NULL,2104);
INSERT INTO "jobs" VALUES('22222222222222222222222222222222','1','7682d1ebda2b31857c65bc01bd9dd4d26e0789c7b55a6fa4928e750b38088cb8','second','ada','queued',NULL,0,68,'2026-11-20 08:30:00.000000',NULL,NULL,NULL,'2026-11-20 08:30:00.000000',NULL,0,0,0,NULL,2105);
CREATE TABLE rank_groups (
	season VARCHAR(40) NOT NULL, 
	fingerprint VARCHAR(64) NOT NULL, 
	groups JSON NOT NULL, 
	PRIMARY KEY (season, fingerprint), 
	FOREIGN KEY(season) REFERENCES seasons (name)
);
INSERT INTO "rank_groups" VALUES('1','0bac46368adccbe9939a4bb05b30bf537e5cc868aef9f6df7bf6257cfe995528','[[1, [["6d696e656d696e656d696e656d696e656d696e656d696e656d696e656d696e65"]]]]');
CREATE TABLE seasons (
	number INTEGER NOT NULL, 
	name VARCHAR(40) NOT NULL, 
	suite TEXT NOT NULL, 
	suite_digest TEXT NOT NULL, 
	commitment VARCHAR(64) NOT NULL, 
	began_at DATETIME NOT NULL, 
	taking BOOLEAN NOT NULL, 
	PRIMARY KEY (number), 
	UNIQUE (name)
);
INSERT INTO "seasons" VALUES(1,'1','quick-v1','a00e950194ab1919','46eed9d5b9f316d5bbd41674f6257a91e64787ab760cbda8b05cc96269512994','2026-11-20 08:30:00.000000',1);
CREATE TABLE tokens (
	number INTEGER NOT NULL, 
	name TEXT NOT NULL, 
	sha256 VARCHAR(64) NOT NULL, 
	added_at DATETIME NOT NULL, 
	revoked_at DATETIME, 
	PRIMARY KEY (number), 
	UNIQUE (sha256)
);
INSERT INTO "tokens" VALUES(1,'ada','f163ec717a0eafff5604545831db8fd89dc523535890724b7fd3bbdc616b95a6','2026-11-20 08:30:00.000000',NULL);
CREATE INDEX ix_entries_name ON entries (name);
CREATE INDEX ix_hidden_errors_of ON hidden_errors (season, submission);
CREATE INDEX ix_events_of ON events (season, submission);
CREATE INDEX ix_jobs_submitter ON jobs (submitter);
CREATE INDEX ix_jobs_state ON jobs (state);
CREATE TRIGGER seasons_no_UPDATE BEFORE UPDATE ON seasons
BEGIN SELECT RAISE(ABORT, 'seasons is append-only'); END;
CREATE TRIGGER seasons_no_DELETE BEFORE DELETE ON seasons
BEGIN SELECT RAISE(ABORT, 'seasons is append-only'); END;
CREATE TRIGGER entries_no_UPDATE BEFORE UPDATE ON entries
BEGIN SELECT RAISE(ABORT, 'entries is append-only'); END;
CREATE TRIGGER entries_no_DELETE BEFORE DELETE ON entries
BEGIN SELECT RAISE(ABORT, 'entries is append-only'); END;
CREATE TRIGGER hidden_errors_no_UPDATE BEFORE UPDATE ON hidden_errors
BEGIN SELECT RAISE(ABORT, 'hidden_errors is append-only'); END;
CREATE TRIGGER hidden_errors_no_DELETE BEFORE DELETE ON hidden_errors
BEGIN SELECT RAISE(ABORT, 'hidden_errors is append-only'); END;
CREATE TRIGGER events_no_UPDATE BEFORE UPDATE ON events
BEGIN SELECT RAISE(ABORT, 'events is append-only'); END;
CREATE TRIGGER events_no_DELETE BEFORE DELETE ON events
BEGIN SELECT RAISE(ABORT, 'events is append-only'); END;
COMMIT;
