// The package in browsers: files are fetched. node.js is the same in node. Types are in lipz.d.ts.

import { openerWith } from "./open.js";
import * as web from "./read-web.js";

export * from "./exports.js";

export const openDialogue = openerWith(web);
