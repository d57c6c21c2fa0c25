"use strict";
// The page of live lifts: messages of the room, actions of the person, and their display.
(function () {
  const play = window.coliftPlay;

  const FIRST_PINGS = 40;
  const PINGS = 10;

  const at = (id) => document.getElementById(id);
  const { root } = document.body.dataset;

  class Page {
    constructor(geometry) {
      this.state = null;
      this.told = new play.Told();
      this.stage = new play.Stage(at("stage"), geometry);
      this.clock = new play.Clock();
      this.connection = new play.Connection(root, {
        message: (message) => this.take(message),
        frame: (buffer) => this.lifting.frame(buffer),
        lost: (sentence) => this.away(sentence),
        ended: (sentence, why) => this.ended(sentence, why),
      });
      this.lifting = new play.Lifting(this.stage, this.connection, this.clock, {
        changed: () => this.show(),
        finished: (end, delays) => this.finished(end, delays),
        counted: (seconds) => seconds && this.told.say(`Hold still: a line appears in ${seconds} s.`),
        cued: (height, from) => this.told.say(play.goalWords(height, from)),
        slow: (slow) => (at("slow").hidden = !slow),
      });
      this.input = new play.Input(at("input"), () => this.stage, () => at("stage").focus());
      at("input").addEventListener("input", () => this.show());
      this.lobby = new play.Lobby(at("choice"), at("people"), {
        choose: (choice) => this.choose(choice),
        swap: () => this.connection.send({ type: "swap" }),
      });
      this.result = new play.Result(at("result"), this.connection, geometry);
      this.hands = new play.Hands(this);
      this.life = new play.Life({
        hidden: () => this.hidden(),
        left: () => this.connection.drop(),
        back: () => this.connection.place && this.connection.connect(),
      });
      at("next").addEventListener("click", () => this.lobby.next());
      at("change").addEventListener("click", () => this.view("choose"));
      // Another link in the same tab is another session; the skip link is not.
      window.addEventListener("hashchange", () => play.placeOf(window.location.hash) && window.location.reload());
      document.querySelector(".skip").addEventListener("click", (event) => {
        event.preventDefault();
        at("stage").focus();
      });
      this.enter();
    }

    // A hand closes.
    begins() {
      this.result.hide();
      this.explained = false;
      this.told.say("Ready …");
      at("stage").focus({ preventScroll: true });
    }

    get watching() {
      return this.connection.place !== null && this.connection.place.seat === "spectator";
    }

    // Whether this page has an end of the table, or will have one: not if it watches, or if its link
    // leads nowhere.
    get holds() {
      return !this.watching && !this.turnedAway;
    }

    get may() {
      const phase = this.state && this.state.phase;
      const ready = phase === "ready" || phase === "ended";
      const free = !this.lifting.hand.closed && !this.lifting.frames.running; // Its last frames are shown first.
      return ready && this.connection.open && this.settled && !this.watching && free;
    }

    // By a link to a session, or with nothing chosen yet.
    enter() {
      this.connection.place = play.placeOf(window.location.hash);
      if (!this.connection.place) {
        this.view("choose");
        return;
      }
      this.view("table");
      this.told.say("Connecting …");
      this.connection.connect();
    }

    async choose(choice) {
      this.wanted = choice;
      this.result.hide();
      this.view("table");
      if (this.connection.open && this.seated) {
        this.connection.send({ type: "choose", ...choice });
        return;
      }
      this.told.say("Opening a room …");
      try {
        if (!this.connection.place) await this.connection.make();
        this.connection.connect();
      } catch (error) {
        this.told.say(error instanceof TypeError ? "The server cannot be reached. Try again." : error.message);
        this.told.offer("Try again", () => this.choose(choice));
      }
    }

    take(message) {
      const does = {
        pong: () => this.clock.add(message.t, message.room, performance.now()),
        joined: () => this.joined(message),
        queued: () => this.told.say((message.place ? `You are number ${message.place} in the queue. ` : "") + message.reason),
        state: () => this.follow(message),
        start: () => this.lifting.start(message),
        first: () => this.lifting.expect(message),
        cue: () => this.lifting.cue(message),
        end: () => this.over(message),
        void: () => this.over(message),
        standing: () => this.result.compare(message),
        fault: () => this.refused(message.message),
        room_lost: () => {
          this.drop();
          this.settled = this.measured = false;
          this.told.say(message.message);
        },
      }[message.type];
      if (does) does();
    }

    joined(message) {
      this.seated = this.before = true;
      this.turnedAway = false;
      this.settled = this.measured = false;
      this.told.offer(null);
      this.lobby.guest = this.connection.place.seat !== 0;
      this.lobby.links(message.invite, message.watch);
      document.body.dataset.seat = this.connection.place.seat;
      if (this.wanted) this.connection.send({ type: "choose", ...this.wanted });
      this.life.awake(true);
    }

    // Before the first lift in a room, measure the clock, but not while the room prepares.
    async measure() {
      this.measured = true;
      this.clock.reset();
      await this.clock.measure((ping) => this.connection.send(ping), FIRST_PINGS);
      this.settled = true;
      this.show();
    }

    follow(state) {
      const first = !this.state;
      this.state = state;
      if (state.phase !== "preparing" && !this.measured) this.measure();
      if (!state.partner && !this.lobby.guest) {
        this.view("choose");
        return;
      }
      if (first) this.view("table");
      if (this.wanted && this.wanted.partner === state.partner) this.wanted = null;
      this.stage.seat(this.watching ? null : state.you === "far" ? "far" : "human");
      this.stage.company(play.hasHumanFar(state.partner));
      this.lobby.follow(state);
      // During a lift, the lift itself tells what to do.
      const told = state.phase === "ready" ? this.explained : this.lifting.frames.running;
      if (!told) this.told.say(state.message);
      if (state.phase === "lifting") this.explained = false;
      this.show();
    }

    // A lift has ended: with a score, or void.
    over(message) {
      this.hands.end();
      this.explained = true;
      if (message.type === "end") {
        this.lifting.end(message);
        this.told.say("The lift is over.");
      } else {
        this.lifting.drop();
        const again = this.watching ? "" : " Take hold to repeat it.";
        this.told.say(`This lift does not count: ${message.reason}.${again}`);
      }
      this.clock.measure((ping) => this.connection.send(ping), PINGS);
      this.show();
    }

    finished(end, delays) {
      if (!this.watching) for (const report of delays.reports(end.lift)) this.connection.send(report);
      this.result.show(end, this.state.partner, delays, this.state.role);
      this.told.say(play.scoreWords(end));
      this.show();
    }

    // If a grip was refused, the hand must not stay closed.
    refused(sentence) {
      this.told.fault(sentence);
      if (!this.lifting.hand.closed || this.lifting.hand.started) return;
      this.hands.end();
      this.lifting.release();
    }

    drop() {
      this.hands.end();
      this.lifting.drop();
    }

    hidden() {
      if (!this.lifting.hand.closed) return;
      this.lifting.release("hidden");
      this.drop();
    }

    away(sentence) {
      this.seated = this.settled = this.explained = false;
      this.drop();
      this.state = null;
      this.told.say(sentence);
      this.show();
    }

    ended(sentence, why) {
      this.seated = this.settled = false;
      this.turnedAway = !this.before;
      this.drop();
      this.state = null;
      this.life.awake(false);
      this.told.say(sentence);
      if (why === "gone") this.told.offer("Reload", () => window.location.reload());
      else if (why === "taken_over") this.told.offer("Go on here", () => this.connection.connect());
      else if (this.before) this.told.offer("Go on", () => this.connection.connect());
      else this.told.offer("New session", () => (window.location.href = window.location.pathname + window.location.search));
      this.show();
    }

    // At the table the keys work at once, unless the focus is on something that is still there.
    steer() {
      const lost = document.activeElement === document.body || document.activeElement.closest("[hidden]");
      if (this.input.steered && !this.watching && lost) at("stage").focus({ preventScroll: true });
    }

    view(view) {
      document.body.dataset.view = view;
      at("choice").hidden = view !== "choose";
      at("panel").hidden = view !== "table";
      if (view === "table") this.steer();
      this.stage.fit();
      this.show();
      window.scrollTo(0, 0);
    }

    show() {
      const { state } = this;
      const phase = this.lifting.hand.closed && state && state.phase === "ready" ? "gripped" : state ? state.phase : "none";
      document.body.dataset.phase = phase;
      at("partner").textContent = state ? (this.watching ? "A lift with " : "You and ") + play.partnerWords(state.partner) : "The table";
      at("place").textContent = state && state.partner ? play.placeWords(state, this.watching) : "";
      at("lift").hidden = !this.may || this.input.preset === "touch" || document.body.dataset.view !== "table";
      at("touch").hidden = !this.may || this.input.preset !== "touch" || document.body.dataset.view !== "table";
      const over = !this.result.root.hidden;
      at("lift").textContent = over ? "Lift again" : "Lift";
      for (const id of ["change", "next"]) at(id).classList.toggle("away", this.lobby.guest || !this.holds);
      at("how").hidden = !this.holds || !state || over;
      at("input").hidden = !this.holds;
      document.body.dataset.role = (state && state.role) || "";
      this.stage.name(this.holds);
      at("change").disabled = phase === "lifting" || phase === "gripped";
      this.input.show();
    }
  }

  async function begin() {
    try {
      const answer = await fetch(`${root}/api/geometry`);
      if (!answer.ok) throw new Error(`The server answered ${answer.status}.`);
      play.page = new Page(await answer.json());
    } catch (error) {
      at("status").textContent = `The page could not start: ${error.message} Reload the page.`;
    }
  }

  begin();
})();
