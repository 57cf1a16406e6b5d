// The page in Italian: texts whose English the list `italian` has are written in the language of the page.
// Pairs with {} in place of numbers are of parts of texts.
const PAIRS = at("italian").textContent.trim().split("\n").map(pair => pair.split(" | "));
const ITALIAN = new Map(PAIRS);
const PARTS = PAIRS.filter(([words]) => words.includes("{}")).map(([words, italian]) => {
  const pattern = words.replace(/[.*+?^$()|[\]\\]/g, "\\$&").replaceAll("{}", "([\\d.]+)");
  let place = 0;
  return [new RegExp(pattern, "g"), italian.replace(/{}/g, () => `$${place += 1}`)];
});
const isItalian = () => document.documentElement.lang === "it";
function italian(words) {
  return ITALIAN.get(words) ?? PARTS.reduce((text, pair) => text.replace(...pair), words);
}
// The English of texts that the list has.
const english = new WeakMap();
function translate(part) {
  const texts = document.createTreeWalker(part, NodeFilter.SHOW_TEXT);
  for (let text = part.nodeType === Node.TEXT_NODE ? part : texts.nextNode(); text; text = texts.nextNode()) {
    const own = english.get(text) ?? text.data, words = own.trim().replace(/\s+/g, " ");
    if (isItalian() && /[a-z]/i.test(words) && !text.parentElement?.closest("script, pre, textarea")) {
      english.set(text, own);
      text.data = own.replace(/\S[^]*\S|\S/, () => italian(words));
    } else if (english.has(text)) {
      text.data = own;
    }
  }
}
// Shows the page in a language; the check answers in it.
function speak(language) {
  document.documentElement.lang = language;
  translate(document.body);
  schedule();
}
new MutationObserver(changes => {
  for (const { addedNodes } of changes) { addedNodes.forEach(translate); }
}).observe(document.body, { childList: true, subtree: true });
