// Colours, `#rrggbb`.

/** Mixes colours, each with its share. */
export function mixed(shares) {
  const channel = (at) => shares.reduce((sum, [colour, share]) => sum + share * parseInt(colour.slice(at, at + 2), 16), 0);
  const hex = (at) => Math.round(Math.max(0, Math.min(255, channel(at)))).toString(16).padStart(2, "0");
  return `#${hex(1)}${hex(3)}${hex(5)}`;
}
