// Finds sections of the site's documents by words: the script that a page loads once its search is used, with the text of every document.

const mostFound = 20;  // results
const around = 70;  // characters of context before a word and after it
const fillers = new Set('a an and are be by can do does for from how i in is it many much my of on or the to what when where which why with'.split(' '));
const wordsIn = (text) => [...text.matchAll(/[\p{L}\p{N}]+/gu)].map(({ 0: word, index }) => ({ word: word.toLowerCase(), index }));

/** Where each word stands in one kind of text of all sections, and how much it counts there: more often counts more, and less in a long text (as BM25 has it). */
class Field {
  constructor(texts) {
    this.places = new Map();  // word -> section -> times
    this.lengths = texts.map((text, section) => {
      const words = wordsIn(text);
      for (const { word } of words) {
        if (!this.places.has(word)) this.places.set(word, new Map());
        this.places.get(word).set(section, (this.places.get(word).get(section) ?? 0) + 1);
      }
      return words.length;
    });
    this.mean = this.lengths.reduce((sum, length) => sum + length, 0) / texts.length || 1;
  }

  count(word, section) {
    const times = this.places.get(word)?.get(section) ?? 0;
    return times / (times + 0.5 + this.lengths[section] / this.mean);
  }
}

/** Whether one word becomes the other by at most `most` letters put in, left out or changed. */
function isNear(a, b, most) {
  if (Math.abs(a.length - b.length) > most) return false;
  let row = [...b, ''].map((_, k) => k);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let k = 1; k <= b.length; ++k) next.push(Math.min(row[k] + 1, next[k - 1] + 1, row[k - 1] + (a[i - 1] === b[k - 1] ? 0 : 1)));
    row = next;
  }
  return row[b.length] <= most;
}

/** The words that are meant by `word`, each with its weight: itself, what begins with it or its stem, or, where there is none, what it may be a slip for. */
function meantBy(word, vocabulary) {
  const stem = word.length > 5 ? word.replace(/(?:ing|ed|es|s|e)$/, '') : word;
  const begun = vocabulary.filter((known) => known.startsWith(stem));
  if (begun.length > 0) return begun.map((known) => [known, known === word ? 1 : known.startsWith(word) ? 0.5 : 0.3]);
  return word.length < 4 ? [] : vocabulary.filter((known) => isNear(word, known, word.length > 7 ? 2 : 1)).map((known) => [known, 0.5]);
}

/** The text around where most of `words` stand together, in pieces, of which every second one is one of them. */
function contextOf(text, words) {
  const places = wordsIn(text).filter(({ word }) => words.has(word));
  const together = (k) => new Set(places.slice(k, k + 8).filter(({ index }) => index < places[k].index + around).map(({ word }) => word)).size;
  const at = places[places.reduce((best, _, k) => (together(k) > together(best) ? k : best), 0)]?.index ?? 0;
  const from = at > around ? text.indexOf(' ', at - around) + 1 : 0;
  const to = text.length > at + around ? Math.max(at, text.lastIndexOf(' ', at + around)) : text.length;
  const pieces = [from > 0 ? '… ' : ''];
  let written = from;
  for (const { index, word } of places.filter((place) => place.index >= from && place.index + place.word.length <= to)) {
    pieces.push(pieces.pop() + text.slice(written, index), text.slice(index, index + word.length), '');
    written = index + word.length;
  }
  return [...pieces.slice(0, -1), pieces.at(-1) + text.slice(written, to) + (to < text.length ? ' …' : '')];
}

/** `pages`: [address, weight, then [anchor, heading, text] of each section]. Gives find(question): the best sections, each { address, title, heading, context }. */
export function indexOf(pages) {
  const sections = pages.flatMap(([address, weight, ...parts]) => parts.map(([anchor, heading, text], k) => ({
    address: k > 0 ? `${address}#${encodeURIComponent(anchor)}` : address, weight, title: parts[0][1], heading, text,
  })));
  const fields = [['heading', 3], ['title', 0.5], ['text', 1]].map(([name, weight]) => ({ field: new Field(sections.map((section) => section[name])), weight }));
  const vocabulary = [...new Set(fields.flatMap(({ field }) => [...field.places.keys()]))];

  const countOf = (words, section) => Math.max(0, ...words.map(([word, weight]) => weight * fields.reduce((sum, each) => sum + each.weight * each.field.count(word, section), 0)));

  return (question) => {
    const asked = wordsIn(question).map(({ word }) => word);
    const telling = asked.filter((word) => !fillers.has(word));
    const meant = (telling.length > 0 ? telling : asked).map((word) => meantBy(word, vocabulary));
    // A word that few sections have says more; a section that has all words comes before those that have some.
    const scores = sections.map(() => ({ score: 0, known: 0 }));
    for (const words of meant) {
      const counts = sections.map((_, section) => countOf(words, section));
      const rarity = Math.log(1 + sections.length / (1 + counts.filter((count) => count > 0).length));
      counts.forEach((count, section) => {
        scores[section].score += rarity * count;
        if (count > 0) scores[section].known += rarity;
      });
    }
    const words = new Set(meant.flat().map(([word]) => word));
    return scores.map(({ score, known }, section) => ({ ...sections[section], score: score * known ** 2 * sections[section].weight })).filter(({ score }) => score > 0)
      .sort((a, b) => b.score - a.score).slice(0, mostFound).map((section) => ({ ...section, context: contextOf(section.text, words) }));
  };
}
