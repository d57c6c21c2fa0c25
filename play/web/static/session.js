"use strict";
// The session: the identity of this page, and its connection, which reconnects by itself.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const PAUSES_MS = [250, 500, 1000, 2000, 4000];
  const GIVE_UP_S = 60;
  const TAKEN_OVER = 4001;
  const REFUSED = 4003;
  const PING_MS = 2000;
  const SILENT_MS = 7000; // without answers for that long, a connection is dead
  const GONE = `The server has not answered for ${GIVE_UP_S} s. Reload the page when it is back.`;
  const SEATS = { s: 0, p: 1, w: "spectator" };

  // The content of the address after its #: {session, secret, seat}, or null.
  play.placeOf = function (fragment) {
    const found = /^#?([spw])=([A-Za-z0-9_-]+)\.([A-Za-z0-9_-]+)$/.exec(fragment);
    return found && { seat: SEATS[found[1]], session: found[2], secret: found[3] };
  };

  play.fragmentOf = function (kind, token) {
    return `#${kind}=${token}`;
  };

  class Connection {
    // told: {message(object), frame(buffer), lost(sentence), ended(sentence, why)}.
    constructor(root, told) {
      this.root = root;
      this.told = told;
      this.place = null;
      this.socket = null;
      this.failures = 0;
      this.lost = null; // when the connection was lost, until it is back
      setInterval(() => this.look(), PING_MS);
    }

    // Create a session.
    async make() {
      const answer = await fetch(`${this.root}/api/sessions`, { method: "POST" });
      const content = await answer.json().catch(() => ({}));
      if (!answer.ok) throw new Error(content.error || content.detail || `The server answered ${answer.status}.`);
      this.place = { seat: 0, session: content.session, secret: content.secret };
      window.history.replaceState(null, "", play.fragmentOf("s", `${content.session}.${content.secret}`));
    }

    connect() {
      clearTimeout(this.timer);
      if (this.socket) this.drop();
      this.wanted = true;
      const address = new URL(`${this.root}/socket`, window.location.href);
      address.protocol = address.protocol.replace("http", "ws");
      const socket = (this.socket = new WebSocket(address));
      socket.binaryType = "arraybuffer";
      this.heard = performance.now();
      socket.addEventListener("open", () => {
        const { session, secret, seat } = this.place;
        this.send({ type: "join", session, secret, seat });
      });
      socket.addEventListener("message", (event) => {
        if (socket === this.socket) this.take(event.data);
      });
      socket.addEventListener("close", (event) => {
        if (socket === this.socket) this.closed(event.code);
      });
    }

    take(data) {
      this.heard = performance.now();
      this.lost = null;
      clearTimeout(this.last);
      if (typeof data !== "string") {
        this.told.frame(data);
        return;
      }
      const message = JSON.parse(data);
      if (message.type === "joined") this.failures = 0;
      if (message.type === "taken_over" || message.type === "refused") {
        this.end(message.message, message.type);
      } else this.told.message(message);
    }

    closed(code) {
      this.socket = null;
      if (code === TAKEN_OVER) {
        this.end("This session is open in another tab or window. This one has let go.", "taken_over");
      } else if (code === REFUSED) {
        this.end("The server does not know this session. Start a new one.", "refused");
      } else if (this.wanted) {
        const pause = PAUSES_MS[Math.min(this.failures++, PAUSES_MS.length - 1)];
        this.told.lost(`The connection was lost. Trying again for ${this.patience()} s …`);
        this.timer = setTimeout(() => this.connect(), pause);
      }
    }

    // Seconds for which it still tries to connect; they begin with the loss.
    patience() {
      const now = performance.now();
      if (this.lost === null) {
        this.lost = now;
        // An attempt may hang for minutes: it does not decide.
        this.last = setTimeout(() => this.end(GONE, "gone"), 1000 * GIVE_UP_S);
      }
      return Math.max(Math.ceil(GIVE_UP_S - (now - this.lost) / 1000), 0);
    }

    end(sentence, why) {
      this.drop();
      this.told.ended(sentence, why);
    }

    // Leave, and stay away until connect() is called again.
    drop() {
      this.wanted = false;
      this.lost = null;
      clearTimeout(this.last);
      clearTimeout(this.timer);
      const { socket } = this;
      this.socket = null;
      if (socket) socket.close();
    }

    // A pulled cable does not close a connection.
    look() {
      if (!this.open || document.hidden) {
        this.heard = performance.now();
        return;
      }
      if (performance.now() - this.heard > SILENT_MS) {
        const { socket } = this;
        this.socket = null;
        socket.close();
        this.closed(0);
      } else this.send({ type: "ping", t: performance.now() });
    }

    get open() {
      return this.socket !== null && this.socket.readyState === WebSocket.OPEN;
    }

    send(message) {
      if (this.open) this.socket.send(message instanceof ArrayBuffer ? message : JSON.stringify(message));
    }

    // One of the session's lifts, in the form for the replay player.
    async replay(lift) {
      const { session, secret } = this.place;
      const number = String(lift).padStart(3, "0");
      const answer = await fetch(`${this.root}/api/sessions/${session}/lifts/${number}/replay`, {
        headers: { Authorization: `Bearer ${session}.${secret}` },
        cache: "no-store",
      });
      if (!answer.ok) throw new Error("There is no replay of this lift yet. Try again in a moment.");
      return answer.json();
    }
  }

  play.Connection = Connection;
})();
