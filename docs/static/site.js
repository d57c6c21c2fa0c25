// What scrolls can be reached with the keyboard, and takes no place in the order of Tab if it does not scroll.
const BOXES = "pre, .table-wrapper, .drawing, div.formula, div.output";

function mark(box) {
  const scrolls = box.scrollWidth > box.clientWidth || box.scrollHeight > box.clientHeight + 1;
  if (scrolls) box.tabIndex = 0;
  else box.removeAttribute("tabindex");
}

// The content may grow in a box that keeps its size, as when a font arrives; a folded box is not observed.
const boxes = document.querySelectorAll(BOXES);
const sizes = new ResizeObserver((seen) => seen.forEach(({ target }) => mark(target.closest(BOXES))));
for (const box of boxes) for (const each of [box, ...box.children]) sizes.observe(each);
addEventListener("resize", () => boxes.forEach(mark));

// The theme has two landmarks of one kind without names, and Sphinx headings of lists without a level.
document.querySelector(".sidebar-drawer")?.setAttribute("aria-label", "Site");
document.querySelector(".toc-drawer")?.setAttribute("aria-label", "Page");
for (const heading of document.querySelectorAll(".caption[role=heading]")) heading.ariaLevel = "2";
