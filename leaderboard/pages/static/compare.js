// The compare page. Files hold all policies: those of the address, ?p=DIGEST, are shown.
"use strict";
(() => {
  const form = document.getElementById("choice");
  const selects = [...form.querySelectorAll("select")];
  form.addEventListener("submit", () => {  // What was left open does not stand in the address.
    for (const select of selects) select.disabled = !select.value;
  });
  addEventListener("pageshow", () => { for (const select of selects) select.disabled = false; });
  const comparison = document.getElementById("comparison");
  if (!comparison || !comparison.hidden) return;
  const known = new Set([...selects[0].options].map((option) => option.value).filter(Boolean));
  const asked = new URLSearchParams(location.search).getAll("p").filter((digest) => known.has(digest));
  const chosen = [...new Set(asked)].slice(0, selects.length);
  selects.forEach((select, i) => { select.value = chosen[i] || ""; });
  const enough = chosen.length > 1;
  document.getElementById("few").hidden = enough;
  comparison.hidden = !enough;
  for (const row of comparison.querySelectorAll("[data-p]"))
    row.hidden = !row.dataset.p.split(" ").every((digest) => chosen.includes(digest));
})();
