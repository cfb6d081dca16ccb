// The shapes of a model, by their names: which of them take the weights of a rig.

import { Rig } from "./articulation.js";
import { nearest } from "./nearest.js";
import { KINDS, formsOf, lettersOf } from "./shape-names.js";

/** The most names that a report lists. */
const LISTED = 5;

/**
 * Recognises the shapes of a model by their names, in the order of the model, or as an object with the index of each
 * name. With a rig of a bank, finds the shapes for its weights.
 */
export function rig(names, bankRig) {
  const places = placesOf(names);
  const forms = indexOf(places.keys());
  if (bankRig instanceof Rig) {
    const { name: kind, weightNames } = bankRig;
    return new Shapes(places, { kind, weightNames, found: found(forms, weightNames, KINDS[kind]?.also) });
  }
  if (bankRig !== undefined) throw new TypeError(`${String(bankRig)} is not a rig: look it up, with dialogue.rig(name)`);
  return new Shapes(places, recognised(forms));
}

class Shapes {
  #names;
  /** The index of each weight that has a shape, and the index of that shape. */
  #from;
  #to;

  constructor(places, { kind, weightNames, found }) {
    this.kind = kind;
    this.weightNames = Object.freeze([...weightNames]);
    this.map = Object.freeze(Object.fromEntries(Array.from(found, ([weight, name]) => [weight, places.get(name)])));
    this.#names = Array.from(found.values());
    this.#from = Uint32Array.from(found.keys(), (weight) => weightNames.indexOf(weight));
    this.#to = Uint32Array.from(this.#names, (name) => places.get(name));
    const used = new Set(this.#names);
    const others = Array.from(places.keys()).filter((name) => !used.has(name));
    this.missing = Object.freeze(missingOf(this, others));
    this.report = reportOf(this, others);
  }

  /** Writes each weight to the influence of its shape. */
  apply(weights, influences) {
    this.#mustFit(weights);
    for (let i = 0; i < this.#from.length; i++) influences[this.#to[i]] = weights[this.#from[i]];
  }

  /** Calls a function with the name of each shape, its weight and its index. */
  forEach(weights, set) {
    this.#mustFit(weights);
    for (let i = 0; i < this.#from.length; i++) set(this.#names[i], weights[this.#from[i]], this.#to[i]);
  }

  /** Shows only the shape of a viseme. */
  show(viseme, influences) {
    for (let i = 0; i < this.#to.length; i++) {
      influences[this.#to[i]] = this.weightNames[this.#from[i]] === viseme ? 1 : 0;
    }
  }

  #mustFit({ length }) {
    const { weightNames, kind } = this;
    if (kind === undefined) throw new RangeError(this.report);
    if (length === weightNames.length) return;
    const remedy = `pass their rig, as in rig(names, dialogue.rig("${kind}"))`;
    throw new RangeError(`there are ${length} weights, but ${weightNames.length} of ${kind}: ${remedy}`);
  }
}

/** The index of each name. The first of equal names counts. */
function placesOf(names) {
  if (typeof names !== "object" || names === null) throw new TypeError(`${String(names)} is not a list of names`);
  const isList = Symbol.iterator in names;
  const entries = isList ? Array.from(names, (name, index) => [String(name), index]) : Object.entries(names);
  const places = new Map();
  for (const [name, index] of entries) if (!places.has(name)) places.set(name, index);
  return places;
}

/** For each degree of similarity, the names of the model by their form. */
function indexOf(names) {
  const degrees = [];
  for (const name of names) {
    formsOf(name).forEach((form, degree) => {
      const index = (degrees[degree] ??= new Map());
      if (form !== "" && !index.has(form)) index.set(form, name);
    });
  }
  return degrees;
}

/** The name of the model for each weight that has one. */
function found(degrees, weightNames, also = {}) {
  const pairs = weightNames.map((weight) => {
    const known = [weight, ...(also[weight] ?? [])].map(lettersOf);
    // The own form of a weight comes last: a rig may have the prefix that the model lacks.
    known.push(formsOf(weight).at(2));
    for (const index of degrees) {
      const name = known.find((form) => index.has(form));
      if (name !== undefined) return [weight, index.get(name)];
    }
    return [weight, undefined];
  });
  return new Map(pairs.filter(([, name]) => name !== undefined));
}

/** The kind of which the model has the most shapes of the mouth. */
function recognised(degrees) {
  let best = { kind: undefined, weightNames: [], found: new Map(), count: 0 };
  for (const [kind, { mouth, rest, also }] of Object.entries(KINDS)) {
    const count = found(degrees, mouth, also).size;
    if (count <= best.count) continue;
    const weightNames = [...mouth, ...rest];
    best = { kind, weightNames, found: found(degrees, weightNames, also), count };
  }
  return best;
}

/** Each weight without a shape, and the name of the model that is probably meant by it. */
function missingOf({ kind, weightNames, map }, others) {
  const near = (name) => ({ name, suggestion: nearest(name, others) });
  if (kind !== undefined) return weightNames.filter((name) => !Object.hasOwn(map, name)).map(near);
  const known = Object.values(KINDS).flatMap(({ mouth, rest }) => [...mouth, ...rest]);
  return known.map(near).filter(({ suggestion }) => suggestion !== undefined);
}

/** A sentence about missing shapes; undefined if none is missing. */
function reportOf({ kind, weightNames, missing }, others) {
  const words = missing.map(({ name, suggestion }) => (suggestion ? `${name} (did you mean ${suggestion}?)` : name));
  if (kind === undefined) {
    const hint = words.length > 0 ? `expected ${listed(words)}` : "pass the rig that names them, or rename them";
    return `none of ${others.length} shapes has a known name (${listed(others)}); ${hint}`;
  }
  if (missing.length === 0) return undefined;
  return `${missing.length} of ${weightNames.length} shapes of ${kind} are missing: ${listed(words)}`;
}

function listed(words) {
  const more = words.length - LISTED;
  return [...words.slice(0, LISTED), ...(more > 0 ? [`${more} more`] : [])].join(", ");
}
