// Markdown as the documents have it: formulas become MathML while the site is built, and a block of a console knows commands from output.
import katex from 'katex';
import markdownIt from 'markdown-it';

export const markdown = markdownIt({ html: false });
const { escapeHtml } = markdown.utils;

const typeset = (formula, displayMode) => katex.renderToString(formula, { output: 'mathml', displayMode });

// `$...$`, or $`...`$, as GitHub reads it: no space within the dollars, no letter or digit against them, so that prices stay prices.
const formulaIn = /\$(?=[^\s$])((?:\\.|[^$\\])*?)(?<!\s)\$(?![\w$])/y;

function formulaRule(state, silent) {
  if (state.src[state.pos] !== '$' || /[\w$]/.test(state.src[state.pos - 1] ?? ' ')) return false;
  formulaIn.lastIndex = state.pos;
  const found = formulaIn.exec(state.src);
  if (!found) return false;
  if (!silent) state.push('formula', 'math', 0).content = found[1].replace(/^`(.*)`$/s, '$1');
  state.pos = formulaIn.lastIndex;
  return true;
}

// Lines that begin with "$ " are commands, and so is what a backslash at the end carries on; the rest is what they print.
function consoleLines(text) {
  let carriedOn = false;
  return text.replace(/\n$/, '').split('\n').map((line) => {
    const [, prompt, command] = /^(\$ |> )?(.*)$/.exec(line);
    const isCommand = carriedOn || prompt === '$ ';
    carriedOn = isCommand && line.endsWith('\\');
    return isCommand ? `<span class="prompt">${escapeHtml(prompt ?? '')}</span><span class="command">${escapeHtml(command)}</span>` : escapeHtml(line);
  }).join('\n');
}

function codeBlock(text, language) {
  const code = language === 'console' || text.startsWith('$ ') ? consoleLines(text) : escapeHtml(text);
  return `<pre tabindex="0"><code>${code}</code></pre>\n`;
}

markdown.inline.ruler.after('escape', 'formula', formulaRule);
Object.assign(markdown.renderer.rules, {
  formula: (tokens, k) => typeset(tokens[k].content, false),
  code_block: (tokens, k) => codeBlock(tokens[k].content, ''),
  fence: (tokens, k) => {
    const { content, info } = tokens[k];
    const language = info.trim().split(/\s/)[0];
    return language === 'math' ? `<div class="formula" tabindex="0">${typeset(content, true)}</div>\n` : codeBlock(content, language);
  },
});
