// The address of the page: which clip it shows, in which locale, and when.

/** What the address asks for: `bank`, `clip`, `locale` and `at`, each a string or undefined. */
export function asked() {
  return Object.fromEntries(new URLSearchParams(location.search));
}

/** How long the address waits for another change: browsers refuse it to follow a pointer that is dragged. */
const WAIT_MS = 200;

let waiting;

/** Makes the address that of a clip of a bank in a locale at a time, soon; of the first bank, if `bank` is undefined. */
export function follow(bank, clip, locale, time) {
  clearTimeout(waiting);
  waiting = setTimeout(() => write(bank, clip, locale, time), WAIT_MS);
}

function write(bank, clip, locale, time) {
  const query = new URLSearchParams({ ...(bank && { bank }), clip, ...(locale && { locale }), ...(time > 0 && { at: time.toFixed(2) }) });
  // Slashes are allowed in a query, and easier to read.
  history.replaceState(null, "", `?${query.toString().replaceAll("%2F", "/")}`);
}

/** Makes the address that of the page alone: it cannot lead to a file that was dropped. */
export function forget() {
  clearTimeout(waiting);
  history.replaceState(null, "", location.pathname);
}
