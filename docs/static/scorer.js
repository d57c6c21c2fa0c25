// The order of search results: headings with the word, pages that explain, commands and scripts, and the
// code's names last. Sphinx gives a heading up to 15, a text with the word in a heading 15, else 5.
const PLACES = [
  ["guides/", 4], ["start", 4], ["reference/", 3], ["background/changelog", -4], ["background/", 3],
  ["generated/gallery", -4], ["generated/api", -100],
];
const KINDS = { title: 5, object: 5, index: -100 };
const ASKED = (new URLSearchParams(window.location.search).get("q") || "").trim().toLowerCase();

var Scorer = {
  score: ([page, title, , , score, , kind]) => {
    const [, place] = PLACES.find(([start]) => page.startsWith(start)) || ["", 0];
    const named = ASKED && title.toLowerCase().includes(ASKED) ? 2 : 0;
    return score + place + (KINDS[kind] || 0) + named;
  },
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
