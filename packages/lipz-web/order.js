// The order of keys in a bank: by code points, which is also that of their bytes in UTF-8.

/**
 * Compares two strings by code points, for `sort`. `<` compares UTF-16 code units, and so puts U+1F600, which is
 * written with two surrogates from 0xD800 on, before U+FF01.
 */
export function byCodePoints(a, b) {
  for (let at = 0; at < a.length && at < b.length; at++) {
    const [left, right] = [a.charCodeAt(at), b.charCodeAt(at)];
    if (left !== right) return isSurrogate(left) - isSurrogate(right) || left - right;
  }
  return a.length - b.length;
}

function isSurrogate(unit) {
  return unit >= 0xd800 && unit <= 0xdfff;
}
