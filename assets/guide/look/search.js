/* The guide's search.  window.GUIDE: for each page its sections, [anchor, heading, text]; the first is the page's own.

   A page is scored by BM25 over its words, with those of its title and headings counting more, and by how much of the
   question it has.  Questions may be whole sentences: common words count for next to nothing. */
"use strict";

const COMMON = new Set(("a an and are as at be between by can do does for from get how i if in is it its me my of on one or " +
  "so than that the their them there these they this to two up use using want what when where which with without " +
  "you your have has make made not no all any into other same each should would about").split(" "));
const KINDS = {start: ["Getting started", 1.15], "how-to": ["How-to", 1.3], explanation: ["Explanation", 1.1],
  gallery: ["Gallery", 0.9], "reference/api": ["Library", 0.75], reference: ["Reference", 0.8]};
const TITLE = 6, HEADING = 2.5;

/* The stem of a word, so that "distances", "measured" and "exporting" find "distance", "measure" and "export". */
function stem(word) {
  for (const [end, instead] of [["ies", "y"], ["ie", "y"], ["sses", "ss"], ["rices", "rix"], ["ices", "ex"], ["ations", "at"], ["ation", "at"], ["ing", ""],
    ["ed", ""], ["es", ""], ["s", ""], ["e", ""]]) {
    if (word.endsWith(end) && word.length - end.length >= 3 && !word.endsWith("ss")) { word = word.slice(0, -end.length) + instead; break; }
  }
  return word.endsWith("e") && word.length > 3 ? word.slice(0, -1) : word;
}

function words(text) {
  return (text.toLowerCase().normalize("NFKD").replace(/[\u0300-\u036f]/g, "").match(/[a-z0-9]+/g) || []).map(stem);
}

function count(into, text, weight) {
  for (const word of words(text)) into.set(word, (into.get(word) || 0) + weight);
}

function kind(page) {
  const parts = page.split("/");
  return KINDS[parts.slice(0, 2).join("/")] || KINDS[parts[0]] || ["", 0.8];
}

function indexed(pages) {
  const index = pages.map(({page, sections}) => {
    const counts = new Map();
    sections.forEach(([, heading, text], k) => { count(counts, heading, k ? HEADING : TITLE); count(counts, text, 1); });
    return {page, sections, counts, length: [...counts.values()].reduce((a, b) => a + b, 0),
      title: new Set(sections.length ? words(sections[0][1]) : [])};
  });
  const holders = new Map();
  for (const each of index) for (const word of each.counts.keys()) holders.set(word, (holders.get(word) || 0) + 1);
  const mean = index.reduce((sum, each) => sum + each.length, 0) / Math.max(1, index.length);
  return {index, holders, mean};
}

/* The pages that answer a question, the best first: {page, title, kind, anchor, heading, text}. */
function answers({index, holders, mean}, question) {
  const asked = (question.toLowerCase().match(/[\p{L}\p{N}]+/gu) || []);
  const telling = asked.filter((word) => !COMMON.has(word));
  const terms = [...new Set((telling.length ? telling : asked).flatMap((word) => words(word)))];
  if (!terms.length) return [];
  const rarity = new Map();
  for (const term of terms) {
    const among = holders.get(term) || [...holders.keys()].filter((word) => word.startsWith(term)).length;
    rarity.set(term, Math.log(1 + (index.length + 0.5) / (among + 0.5)));
  }
  const most = [...rarity.values()].reduce((a, b) => a + b, 0);
  const found = [];
  for (const each of index) {
    let score = 0, has = 0;
    for (const term of terms) {
      let times = each.counts.get(term) || 0;
      if (!times && term.length > 2) for (const [word, k] of each.counts) if (word.startsWith(term)) times += 0.5 * k;
      if (!times) continue;
      const saturated = times * 2.2 / (times + 1.2 * (0.4 + 0.6 * each.length / mean));
      score += rarity.get(term) * (saturated + (each.title.has(term) ? 1.5 : 0));
      has += rarity.get(term);
    }
    if (score) found.push({...best(each, terms, rarity), page: each.page, score: score * (has / most) ** 2 * kind(each.page)[1]});
  }
  return found.sort((a, b) => b.score - a.score).slice(0, 30);
}

/* The section of a page that has most of the terms. */
function best({page, sections}, terms, rarity) {
  let most = -1, chosen = sections[0];
  for (const section of sections) {
    const heading = new Set(words(section[1])), text = new Set(words(section[2]));
    let sum = 0;
    for (const term of terms) sum += rarity.get(term) * ((text.has(term) ? 1 : 0) + (heading.has(term) ? 0.5 : 0));
    if (sum > most + 1e-9) { most = sum; chosen = section; }
  }
  return {title: sections[0][1], kind: kind(page)[0], anchor: chosen[0], heading: chosen[1], text: excerpt(chosen[2], terms)};
}

/* Some thirty words around the first that are asked for. */
function excerpt(text, terms) {
  const all = text.split(" "), wanted = new Set(terms);
  let at = 0, most = 0;
  for (let k = 0; k < all.length; k += 8) {
    const here = new Set(all.slice(k, k + 32).flatMap(words).filter((word) => wanted.has(word))).size;
    if (here > most) { most = here; at = k; }
  }
  return (at ? "… " : "") + all.slice(at, at + 32).join(" ") + (at + 32 < all.length ? " …" : "");
}

function marked(text, terms) {
  const line = document.createElement("p"), wanted = new Set(terms);
  for (const piece of text.split(/([\p{L}\p{N}]+)/u)) {
    const is = wanted.has(words(piece)[0] ?? "");
    line.append(is ? Object.assign(document.createElement("mark"), {textContent: piece}) : piece);
  }
  return line;
}

function show(question) {
  const list = document.getElementById("guide-search-results"), told = document.getElementById("guide-search-count");
  const found = question.trim() ? answers(show.index ??= indexed(window.GUIDE), question) : [];
  const terms = words(question).filter((word) => !COMMON.has(word));
  told.textContent = !question.trim() ? "Ask in your own words." :
    found.length ? `${found.length} ${found.length === 1 ? "page" : "pages"}, the best first` : "No page has these words.";
  list.replaceChildren(...found.map((each) => {
    const item = document.createElement("li"), link = document.createElement("a");
    link.href = each.page + (each.anchor ? `#${each.anchor}` : "");
    link.textContent = each.anchor ? `${each.title}: ${each.heading}` : each.title;
    const label = Object.assign(document.createElement("span"), {className: "kind", textContent: each.kind});
    item.append(link, label, marked(each.text, terms));
    return item;
  }));
}

if (typeof document !== "undefined" && document.getElementById("guide-search-results")) {
  const asked = new URLSearchParams(location.search).get("q") || "";
  show(asked);
  for (const field of document.querySelectorAll(".bd-search-container input[type=search]")) {
    field.value = asked;
    field.addEventListener("input", () => show(field.value));
  }
}
