// Follows a job: requests its progress every second, and shows its outcome.
"use strict";
(() => {
  const box = document.getElementById("job");
  const bar = document.getElementById("bar"), status = document.getElementById("status");
  const state = document.getElementById("state");
  const unattended = document.getElementById("unattended");
  let pause = 1000, last = status.textContent;

  function show(job) {
    state.textContent = job.state;
    if (job.total) bar.value = Math.min(job.done / job.total, 1);
    // A screen reader announces a change of the stage, not each lift.
    const text = job.state === "queued" ? "Waiting." : `${job.stage || job.state}: ${job.done} of ${job.total} lifts.`;
    status.setAttribute("aria-live", text.split(":")[0] === last.split(":")[0] ? "off" : "polite");
    if (job.state !== "queued" || last.split(/[.,]/)[0] !== "Waiting") status.textContent = text;
    last = text;
    unattended.hidden = !job.unattended;
    const told = job.unattended ? job.unattended + ". The submission is kept, and waits for a worker." : "";
    if (unattended.textContent !== told) unattended.textContent = told;
    for (const step of document.querySelectorAll("[data-stage]")) {
      if (step.dataset.stage === job.stage) step.setAttribute("aria-current", "step");
      else step.removeAttribute("aria-current");
    }
  }

  async function follow() {
    try {
      const answer = await fetch(box.dataset.api, { cache: "no-store" });
      if (answer.ok) {
        const job = await answer.json();
        if (job.ended_at) return location.reload();
        show(job);
        pause = 1000;
      } else pause = Math.min(2 * pause, 30000);
    } catch { pause = Math.min(2 * pause, 30000); }  // The service restarts; the job is not lost.
    setTimeout(follow, pause);
  }
  setTimeout(follow, pause);
})();
