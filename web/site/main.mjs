// A page of the site: light or dark.
import { startTheme } from '../report/theme.mjs';
import { themeSwitch } from '../report/theme_switch.mjs';

startTheme();
document.querySelector('#head').append(themeSwitch());
