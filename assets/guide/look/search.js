/* The guide's search.  search-index.js, which is loaded as a script so that it works without a server, has
   window.GUIDE: for each page its keywords and its sections, [anchor, heading, text]; the first is the page's own;
   window.SYNONYMS: for words of other programs and fields, the guide's own.

   A page is scored by BM25 over its words, with those of its title, keywords and headings counting more, and by how
   much of the question it has.  Questions may be whole sentences: common words count for next to nothing. */
"use strict";

const COMMON = new Set(("a an and are as at be between by can do does for from get how i if in is it its me my of on one or " +
  "so than that the their them there these they this to two up use using want what when where which why with without " +
  "you your have has make made not no all any into other same each should would about work works different").split(" "));
const KINDS = {start: ["Getting started", 1.15], "how-to": ["How-to", 1.3], explanation: ["Explanation", 1.1],
  questions: ["Questions", 1.1], gallery: ["Gallery", 0.9], "reference/api": ["Library", 0.75],
  reference: ["Reference", 0.8], development: ["Development", 0.6]};
const TITLE = 6, HEADING = 2.5, SYNONYM = 0.7, NUMBER = 0.3;
const SPELLINGS = [["color", "colour"], ["gray", "grey"], ["center", "centre"], ["license", "licence"], ["neighbor", "neighbour"],
  ["normaliz", "normalis"]];
const NAMES = new Set(["windows", "macos", "dash", "pandas"]);  // which are no plurals

/* The stem of a word, so that "distances", "measured" and "exporting" find "distance", "measure" and "export". */
function stem(word) {
  for (const [theirs, ours] of SPELLINGS) word = word.replace(theirs, ours);
  if (NAMES.has(word)) return word;
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

function indexed(pages, synonyms = {}) {
  const index = pages.map(({page, keywords = "", sections}) => {
    const counts = new Map();
    count(counts, keywords, TITLE);
    sections.forEach(([, heading, text], k) => { count(counts, heading, k ? HEADING : TITLE); count(counts, text, 1); });
    const phrases = [keywords, ...sections.map(([, heading]) => heading)].map((text) => telling(text).flatMap(words).join(" ")).join(" | ");
    return {page, sections, counts, phrases: ` ${phrases} `, length: [...counts.values()].reduce((a, b) => a + b, 0),
      title: new Set(sections.length ? words(sections[0][1]) : [])};
  });
  const holders = new Map();
  for (const each of index) for (const word of each.counts.keys()) holders.set(word, (holders.get(word) || 0) + 1);
  const mean = index.reduce((sum, each) => sum + each.length, 0) / Math.max(1, index.length);
  const others = new Map(Object.entries(synonyms).map(([word, ours]) => [words(word).join(" "), words(ours)]));
  return {index, holders, mean, others};
}

/* The words of a text that are not common, in lower case. */
function telling(text) {
  return (text.toLowerCase().match(/[\p{L}\p{N}]+/gu) || []).filter((word) => !COMMON.has(word));
}

/* What a question asks for: for each of its words the ways to say it, [stems, weight], its own first. */
function asked(question, others) {
  const stems = [...new Set([telling(question).flatMap(words), words(question)].find((each) => each.length) || [])];
  return stems.map((word) => [[[word], 1], ...(others.has(word) ? [[others.get(word), SYNONYM]] : [])]);
}

/* The pages that answer a question, the best first: {page, title, kind, anchor, heading, text, terms}. */
function answers({index, holders, mean, others}, question) {
  const ways = asked(question, others), terms = [...new Set(ways.flat().flatMap(([stems]) => stems))];
  const rarity = new Map(), known = new Set();
  for (const term of terms) {
    const among = holders.get(term) || [...holders.keys()].filter((word) => word.startsWith(term)).length;
    if (among) known.add(term);
    rarity.set(term, Math.log(1 + (index.length + 0.5) / (among + 0.5)) * (/^\d+$/.test(term) ? NUMBER : 1));
  }
  const mean_of = (stems, value) => stems.reduce((sum, term) => sum + value(term), 0) / stems.length;
  // A word that no page has weighs as much as what is meant by it.
  const weights = ways.map((way) => mean_of((way.find(([stems]) => known.has(stems[0])) || way[0])[0], (term) => rarity.get(term)));
  const most = weights.reduce((a, b) => a + b, 0);
  const found = [];
  for (const each of index) {
    const values = new Map();
    for (const term of terms) {
      let times = each.counts.get(term) || 0;
      if (!times && term.length > 2) for (const [word, k] of each.counts) if (word.startsWith(term)) times += 0.5 * k;
      const saturated = times * 2.2 / (times + 1.2 * (0.4 + 0.6 * each.length / mean));
      values.set(term, times && rarity.get(term) * (saturated + (each.title.has(term) ? 1.5 : 0)));
    }
    let score = 0, has = 0;
    ways.forEach((way, k) => {
      const scores = way.map(([stems, weight]) => weight * mean_of(stems, (term) => values.get(term)));
      const parts = way.map(([stems, weight]) => weight * mean_of(stems, (term) => values.get(term) ? 1 : 0));
      score += Math.max(...scores);
      has += weights[k] * Math.max(...parts);
      // Two words that are next to each other in a heading, too.
      if (k && each.phrases.includes(` ${ways[k - 1][0][0][0]} ${way[0][0][0]} `)) score += weights[k - 1] + weights[k];
    });
    if (score) found.push({...best(each, terms, rarity), terms, page: each.page, score: score * (has / most) ** 2 * kind(each.page)[1]});
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

/* Where the first page is, from this one. */
function root() {
  return document.documentElement.dataset.content_root || "";
}

/* The answers as a list: at most so many. */
function show(question, list, count, most = 30) {
  const found = question.trim() ? answers(show.index ??= indexed(window.GUIDE, window.SYNONYMS), question).slice(0, most) : [];
  count.textContent = !question.trim() ? "Ask in your own words." : !found.length ? "No page has these words." :
    found.length === most ? `The best ${most} pages` : `${found.length} ${found.length === 1 ? "page" : "pages"}, the best first`;
  list.replaceChildren(...found.map((each) => {
    const item = document.createElement("li"), link = document.createElement("a");
    link.href = root() + each.page + (each.anchor ? `#${each.anchor}` : "");
    link.textContent = each.anchor ? `${each.title}: ${each.heading}` : each.title;
    const label = Object.assign(document.createElement("span"), {className: "kind", textContent: each.kind});
    item.append(link, label, marked(each.text, each.terms));
    return item;
  }));
}

/* Have a field show answers while it is typed in; the index is loaded when it is first needed. */
function answering(field, list, count, most) {
  const update = () => show(field.value, list, count, most);
  const load = () => {
    if (window.GUIDE) return update();
    if (!answering.script) {
      answering.script = Object.assign(document.createElement("script"), {src: `${root()}search-index.js`});
      document.head.append(answering.script);
    }
    answering.script.addEventListener("load", update, {once: true});
  };
  field.addEventListener("focus", load);
  field.addEventListener("input", load);
  return load;
}

function start() {
  const page = document.querySelector(".bd-search-container input[type=search]");
  if (page) {
    page.value = new URLSearchParams(location.search).get("q") || "";
    answering(page, document.getElementById("guide-search-results"), document.getElementById("guide-search-count"))();
  }
  const form = document.querySelector("#pst-search-dialog form");
  if (form) {
    const count = Object.assign(document.createElement("p"), {className: "guide-search-count", role: "status"});
    const list = Object.assign(document.createElement("ol"), {className: "guide-search-results"});
    form.after(count, list);
    answering(form.querySelector("input"), list, count, 8);
    list.addEventListener("click", () => form.closest("dialog").close());
  }
}

if (typeof document !== "undefined") document.readyState === "loading" ? document.addEventListener("DOMContentLoaded", start) : start();
if (typeof module !== "undefined") module.exports = {answers, indexed};
