// A button on each block of code that copies it; of a console its commands alone.
import { element } from '../report/dom.mjs';

function textOf(block) {
  const commands = [...block.querySelectorAll('.command')].map(({ textContent }) => textContent);
  return commands.length > 0 ? commands.join('\n') : block.textContent.trimEnd();
}

// Where a browser knows no clipboard, as on a page of a server without a certificate, what is selected can be copied by hand.
async function copy(block, button) {
  try {
    await navigator.clipboard.writeText(textOf(block));
    button.textContent = 'Copied';
    setTimeout(() => { button.textContent = 'Copy'; }, 2000);
  } catch {
    getSelection().selectAllChildren(block);
    button.textContent = 'Selected';
  }
}

export function addCopyButtons() {
  for (const block of document.querySelectorAll('#page pre')) {
    const button = element('button', { type: 'button', class: 'copy', onclick: () => copy(block, button), 'aria-live': 'polite' }, 'Copy');
    const frame = element('div', { class: 'code' });
    block.replaceWith(frame);
    frame.append(block, button);
  }
}
