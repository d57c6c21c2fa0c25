// Uploads a zip file with a token; then shows its job. XMLHttpRequest, since fetch reports no progress.
// Shows the submissions of the token's owner. The token stays in this tab.
"use strict";
(() => {
  const address = document.getElementById("address");
  if (address) address.textContent = location.origin + address.dataset.root;
  const form = document.getElementById("upload");
  const [file, token, sent, answer] = ["file", "token", "sent", "answer"].map((id) => document.getElementById(id));
  const button = form.querySelector("button");

  function end(text) {
    answer.textContent = text;
    answer.className = text ? "notice bad" : "";
    button.disabled = false;
    sent.hidden = true;
  }

  function parsed(request) {
    let content = null;
    try { content = JSON.parse(request.responseText); } catch { /* Not from the service: a proxy's page. */ }
    return content;
  }

  form.addEventListener("submit", (event) => {
    event.preventDefault();
    end("");
    if (!file.files.length) return end("Choose a zip file.");
    button.disabled = true;
    sent.hidden = false;
    const request = new XMLHttpRequest();
    request.open("POST", form.dataset.action);
    request.setRequestHeader("Content-Type", "application/zip");
    request.setRequestHeader("Authorization", "Bearer " + token.value.trim());
    request.upload.addEventListener("progress", ({ loaded, total }) => { sent.value = total ? loaded / total : 0; });
    request.addEventListener("load", () => {
      const content = parsed(request);
      if (request.status < 300 && content && /^[0-9a-f]{32}$/.test(content.id)) {
        location.assign(form.dataset.job.replace("ID", content.id));
      } else {
        end("Not accepted: " + (content && content.error || "the service answered " + request.status) );
      }
    });
    request.addEventListener("error", () => end("The service cannot be reached; nothing was submitted. Try again."));
    request.send(file.files[0]);
  });

  // My submissions.
  const KEY = "colift-token";
  const mine = document.getElementById("mine"), whose = document.getElementById("whose"), body = mine.querySelector("tbody");
  try { token.value = sessionStorage.getItem(KEY) || ""; } catch { /* No storage in this browser. */ }
  token.addEventListener("change", () => {
    try { sessionStorage.setItem(KEY, token.value.trim()); } catch { /* It is typed again. */ }
  });

  function link(text, address) {
    const a = document.createElement("a");
    a.href = address;
    a.textContent = text;
    return a;
  }

  function line(job) {
    const row = document.createElement("tr");
    const name = document.createElement("th");
    name.scope = "row";
    name.append(link(job.name, form.dataset.job.replace("ID", job.id)));
    row.append(name);
    const page = form.dataset.policy.replace("SEASON", job.season).replace("DIGEST", job.submission);
    const state = job.state === "done" ? link("done: see its row", page) : job.state + (job.stage ? ", " + job.stage : "");
    const when = new Date(job.submitted_at).toISOString().slice(0, 16).replace("T", ", ") + " UTC";
    for (const each of [when, state, job.state === "queued" ? "" : `${job.done} of ${job.total}`, job.reason || ""]) {
      const cell = document.createElement("td");
      cell.append(each);
      row.append(cell);
    }
    row.children[3].className = "num";
    row.children[4].className = "why";
    return row;
  }

  async function show() {
    mine.hidden = false;
    body.replaceChildren();
    try {
      const answer = await fetch(form.dataset.mine, {
        cache: "no-store", headers: { Authorization: "Bearer " + token.value.trim() },
      });
      const content = await answer.json();
      if (!answer.ok) whose.textContent = content.error || "the service answered " + answer.status;
      else {
        whose.textContent = content.length ? `The last ${content.length}, newest first.` : "Nothing yet.";
        body.replaceChildren(...content.map(line));
      }
    } catch { whose.textContent = "The service cannot be reached. Try again."; }
  }
  document.getElementById("show").addEventListener("click", show);
})();
