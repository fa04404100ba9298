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
      this.said.textContent = await copied(location.href)
        ? 'Copied. Whoever opens the link sees these layouts and the same counts.' : 'Copy the link from the field: this browser does not let the page do it.';
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
