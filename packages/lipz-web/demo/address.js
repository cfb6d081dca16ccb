// The address of the page: its clip, locale and time.

/** The values in the address: `bank`, `clip`, `locale`, `at` and `sprites`, each a string or undefined. */
export function asked() {
  return Object.fromEntries(new URLSearchParams(location.search));
}

/** The delay before the address changes, because browsers refuse to change it on every move of a pointer. */
const WAIT_MS = 200;

let waiting;

/** Soon changes the address to a clip in a bank, a locale and a time; in the first bank, if `bank` is undefined. */
export function follow(bank, clip, locale, time) {
  clearTimeout(waiting);
  waiting = setTimeout(() => write(bank, clip, locale, time), WAIT_MS);
}

function write(bank, clip, locale, time) {
  const { sprites } = asked();
  const query = new URLSearchParams({ ...(sprites && { sprites }), ...(bank && { bank }), clip, ...(locale && { locale }), ...(time > 0 && { at: time.toFixed(2) }) });
  // Slashes are allowed in a query, and easier to read.
  history.replaceState(null, "", `?${query.toString().replaceAll("%2F", "/")}`);
}

/** Changes the address to that of the page alone, because it cannot lead to a dropped file. */
export function forget() {
  clearTimeout(waiting);
  history.replaceState(null, "", location.pathname);
}
