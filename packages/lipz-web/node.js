// The package in node: files are read from disk. lipz.js is the same in browsers. Types are in lipz.d.ts.

import { openerWith } from "./open.js";
import * as node from "./read-node.js";

export * from "./exports.js";

export const openDialogue = openerWith(node);
