// Uploads a zip file with a token; then shows its job. XMLHttpRequest, since fetch tells no progress.
"use strict";
(() => {
  const form = document.getElementById("upload");
  const [file, token, sent, answer] = ["file", "token", "sent", "answer"].map((id) => document.getElementById(id));
  const button = form.querySelector("button");

  function end(text) {
    answer.textContent = text;
    answer.className = text ? "notice bad" : "";
    button.disabled = false;
    sent.hidden = true;
  }

  function told(request) {
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
      const content = told(request);
      if (request.status < 300 && content && /^[0-9a-f]{32}$/.test(content.id)) {
        location.assign(form.dataset.job.replace("ID", content.id));
      } else {
        end("Not accepted: " + (content && content.error || "the service answered " + request.status) );
      }
    });
    request.addEventListener("error", () => end("The service cannot be reached; nothing was submitted. Try again."));
    request.send(file.files[0]);
  });
})();
