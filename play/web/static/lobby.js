"use strict";
// Before a lift: the partner, the cues, and the people in the session.
(function () {
  const play = (window.coliftPlay = window.coliftPlay || {});

  const KEPT = "colift-play-choice";
  const TWO = ["person", "person as robot"];
  const HUMAN_FAR = ["person", "simulated person"];
  const NAMES = { person: "another person", "person as robot": "a person as robot", "simulated person": "a simulated person" };

  play.needsTwo = (partner) => TWO.includes(partner);
  play.hasHumanFar = (partner) => HUMAN_FAR.includes(partner);

  play.partnerWords = (partner) => NAMES[partner] || partner;

  // The place and the role of this person, as sentences.
  play.placeWords = function (state, spectator) {
    if (spectator) return "You watch: you see the table, not the goals.";
    const end = state.you === "far" ? "the left end, in orange" : "the right end, in blue";
    if (state.partner === "person as robot" && state.you === "far") {
      return "You command the robot, at the left end: it follows your hand as far as a robot can. You see the table only.";
    }
    if (!play.needsTwo(state.partner)) return `You hold ${end}, and lead: the goals are shown to you alone.`;
    if (state.role === "follower") return `You hold ${end}, and follow: you see the table, not the goals.`;
    return `You hold ${end}, and lead: the goals are shown to you alone.`;
  };

  play.peopleWords = function (state) {
    if (!play.needsTwo(state.partner)) return "";
    const { people, gripped = [] } = state;
    if (people < 2) return "The second person is not here yet.";
    const closed = gripped.filter(Boolean).length;
    return closed === 1 ? "Both of you are here; one hand is closed." : "Both of you are here.";
  };

  class Lobby {
    // told: {choose(choice), swap()}.
    constructor(form, people, told) {
      this.form = form;
      this.people = people;
      this.told = told;
      this.options = [...form.querySelectorAll("input[name=partner]")];
      const kept = play.read(localStorage, KEPT);
      const known = this.options.find((option) => option.value === kept.partner);
      if (known) known.checked = true;
      if (kept.kind && [...form.elements.kind.options].some((each) => each.value === kept.kind)) {
        form.elements.kind.value = kept.kind;
      }
      form.addEventListener("submit", (event) => {
        event.preventDefault();
        this.choose();
      });
      form.addEventListener("change", () => this.show());
      people.querySelector("#swap").addEventListener("click", () => told.swap());
      for (const button of people.querySelectorAll("[data-copy]")) {
        button.addEventListener("click", () => this.copy(button));
      }
      this.show();
      form.querySelector("button").disabled = false; // Earlier, a press would leave the page.
    }

    get choice() {
      const { kind, latency, partner } = this.form.elements;
      const age = play.needsTwo(partner.value) || play.hasHumanFar(partner.value) ? "" : latency.value;
      return { partner: partner.value, kind: kind.value, latency_ms: age === "" ? null : Number(age) };
    }

    choose() {
      const { choice } = this;
      play.write(localStorage, KEPT, choice);
      this.told.choose(choice);
    }

    // The policy after the present one, in the order of the page; after the last the first.
    next() {
      const policies = this.options.filter((option) => !TWO.includes(option.value));
      const here = policies.findIndex((option) => option.checked);
      policies[(here + 1) % policies.length].checked = true;
      this.show();
      this.choose();
    }

    show() {
      const { partner } = this.form.elements;
      const two = play.needsTwo(partner.value);
      this.form.querySelector("#latency-field").hidden = two || play.hasHumanFar(partner.value);
    }

    // The state of the room, which is right after a reload when the form is not.
    follow(state) {
      const known = this.options.find((option) => option.value === state.partner);
      if (known && state.phase !== "preparing") known.checked = true;
      this.show();
      const two = play.needsTwo(state.partner);
      this.people.hidden = !two && !this.people.dataset.watch;
      this.people.querySelector("#who").textContent = play.peopleWords(state);
      this.people.querySelector("#swap").hidden = !two || this.guest || state.phase === "lifting";
      this.people.querySelector("#invitation").hidden = !two || this.guest || !this.invite;
    }

    // The links of a session, for its host alone.
    links(invite, watch) {
      this.invite = invite;
      const address = (kind, token) => new URL(play.fragmentOf(kind, token), window.location.href).href;
      if (invite) this.people.querySelector("#invite-link").value = address("p", invite);
      if (watch) this.people.querySelector("#watch-link").value = address("w", watch);
      this.people.querySelector("#watching").hidden = !watch;
      this.people.dataset.watch = watch ? "yes" : "";
    }

    async copy(button) {
      const field = document.getElementById(button.dataset.copy);
      try {
        await navigator.clipboard.writeText(field.value);
      } catch {
        field.select();
        document.execCommand("copy");
      }
      button.textContent = "Copied";
      setTimeout(() => (button.textContent = "Copy"), 2000);
    }
  }

  play.Lobby = Lobby;
})();
