// The package in browsers, which fetches files. node.js is its counterpart in node. Types are in lipz.d.ts.

import { openerWith } from "./open.js";
import * as web from "./read-web.js";

export * from "./exports.js";

export const openDialogue = openerWith(web);
