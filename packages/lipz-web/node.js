// The package in node, which reads files from disk. lipz.js is its counterpart in browsers. Types are in lipz.d.ts.

import { openerWith } from "./open.js";
import * as node from "./read-node.js";

export * from "./exports.js";

export const openDialogue = openerWith(node);
