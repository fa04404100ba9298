// A page of the site: the search, light or dark, the page's contents beside it where there is room, and buttons that copy.
import { startTheme } from '../report/theme.mjs';
import { themeSwitch } from '../report/theme_switch.mjs';
import { addCopyButtons } from './copying.mjs';
import { searchField } from './search.mjs';

const head = document.querySelector('#head');
const isWide = matchMedia('(min-width: 1200px)');  // as in style.css

function unfoldContents() {
  const contents = document.querySelector('#contents details');
  if (contents) contents.open = isWide.matches;
}

startTheme();
head.querySelector('.kicker').after(searchField(head.querySelector('.kicker').href));
head.append(themeSwitch());
addCopyButtons();
const menu = document.querySelector('#menu');
menu.scrollTop = (menu.querySelector('[aria-current]')?.offsetTop ?? 0) - menu.clientHeight / 2;  // beside the text it scrolls by itself
unfoldContents();
isWide.addEventListener('change', unfoldContents);
