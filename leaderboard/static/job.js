// Follows a job: requests its progress every second, and shows its outcome.
"use strict";
(() => {
  const box = document.getElementById("job");
  const bar = document.getElementById("bar"), status = document.getElementById("status");
  const state = document.getElementById("state"), time = document.getElementById("time");
  const stages = [...document.querySelectorAll("[data-stage]")];
  const unattended = document.getElementById("unattended");
  let pause = 1000, last = status.textContent;

  function show(job) {
    state.textContent = job.state;
    if (job.total) bar.value = Math.min(job.done / job.total, 1);
    // A screen reader announces a change of the stage, not each lift.
    const text = job.state === "queued" ? "Waiting." : `${job.stage || job.state}: ${job.done} of ${job.total} lifts of all stages.`;
    status.setAttribute("aria-live", text.split(":")[0] === last.split(":")[0] ? "off" : "polite");
    if (job.state !== "queued" || last.split(/[.,]/)[0] !== "Waiting") status.textContent = text;
    last = text;
    unattended.hidden = !job.unattended;
    const told = job.unattended ? job.unattended + ". The submission is kept, and waits for a worker." : "";
    if (unattended.textContent !== told) unattended.textContent = told;
    const now = stages.findIndex((step) => step.dataset.stage === job.stage);
    stages.forEach((step, i) => {
      step.classList.toggle("over", i < now);
      if (i === now) step.setAttribute("aria-current", "step");
      else step.removeAttribute("aria-current");
    });
  }

  // As on the page: 40 s, 12 min, 1 h 5 min.
  function duration(seconds) {
    if (seconds < 100) return `${Math.round(seconds)} s`;
    const minutes = Math.round(seconds / 60), hours = Math.floor(minutes / 60);
    return hours ? `${hours} h ${minutes % 60} min` : `${minutes} min`;
  }

  // By the service's clock. An estimate needs a twentieth of the lifts, and one attempt.
  function tell(job, now) {
    time.hidden = job.state === "queued" || !job.started_at;
    if (time.hidden) return;
    const elapsed = Math.max(0, (now - Date.parse(job.started_at)) / 1000);
    let text = duration(elapsed) + " so far" + (job.attempt > 1 ? ", with earlier attempts" : "");
    if (job.stage === time.dataset.hidden) text += "; the hidden run shows no progress before its end";
    else if (job.attempt === 1 && job.done && job.done >= 0.05 * job.total)
      text += `, about ${duration(elapsed * (job.total - job.done) / job.done)} left`;
    time.textContent = text + ".";
  }

  async function follow() {
    try {
      const answer = await fetch(box.dataset.api, { cache: "no-store" });
      if (answer.ok) {
        const job = await answer.json();
        if (job.ended_at) return location.reload();
        show(job);
        tell(job, Date.parse(answer.headers.get("Date")) || Date.now());
        pause = 1000;
      } else pause = Math.min(2 * pause, 30000);
    } catch { pause = Math.min(2 * pause, 30000); }  // The service restarts; the job is not lost.
    setTimeout(follow, pause);
  }
  setTimeout(follow, pause);
})();
