// A link that holds the layouts on the page.
import { element } from '../report/dom.mjs';
import { sentence } from '../report/format.mjs';
import { fragmentOf } from './link.mjs';

async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;  // a browser may refuse; the field has the link all the same
  }
}

// Whom the link serves. A page that is a file has an address on this computer alone.
function reach() {
  if (location.protocol !== 'file:') return 'Whoever opens the link sees these layouts and the same counts.';
  const file = decodeURIComponent(location.pathname.split('/').pop());
  return `It leads to this file on this computer: whoever else is to open it needs the file ${file} too, and puts what follows # in the link after its address.`;
}

export class Share {
  /** `layouts()`: those that are on the page. */
  constructor(layouts) {
    this.button = element('button', { type: 'button', class: 'quiet', onclick: () => this.share(layouts()) }, 'Share a link');
    this.field = element('input', { type: 'text', class: 'link-field', readonly: true, 'aria-label': 'Link to what is on this page', onfocus: () => this.field.select() });
    this.said = element('p', { class: 'hint', role: 'status' });
    this.frame = element('div', { class: 'share', hidden: true }, this.field, this.said);
  }

  async share(layouts) {
    this.frame.hidden = false;
    try {
      history.replaceState(null, '', await fragmentOf(layouts));
      this.field.value = location.href;
      this.field.hidden = false;
      const how = await copied(location.href) ? 'Copied.' : 'Copy the link from the field: this browser does not let the page do it.';
      this.said.textContent = `${how} ${reach()}`;
    } catch (error) {
      this.field.hidden = true;
      this.said.textContent = sentence(`There is no link: ${error.message}`);
    }
  }

  /** What was shared is no longer what is on the page. */
  hide() {
    this.frame.hidden = true;
  }
}
