// The shapes of a model, by their names: which of them take the weights of a rig.

import { rigOf } from "./articulation.js";
import { nearest } from "./nearest.js";
import { BARE, KINDS, formsOf, lettersOf } from "./shape-names.js";

/** The most names that a report lists. */
const LISTED = 5;

/**
 * Recognises the shapes of a model by their names, in the order of the model, or as an object with the index of each
 * name. With a rig of a bank, finds the shapes for its weights.
 */
export function rig(names, bankRig) {
  const places = placesOf(names);
  const forms = formsIn(places.keys());
  if (bankRig === undefined) return new Shapes(places, recognised(forms));
  const { name: kind, weightNames } = rigOf(bankRig);
  return new Shapes(places, { kind, weightNames, nameOf: namesFor(weightNames, forms, KINDS[kind]?.also) });
}

class Shapes {
  /** The name of each shape that takes a weight. */
  #names;
  /** The index of the weight of each of them, and its own index. */
  #from;
  #to;

  /**
   * @param places the index of each name
   * @param nameOf the name of the model for each weight that has one
   */
  constructor(places, { kind, weightNames, nameOf }) {
    this.kind = kind;
    this.weightNames = Object.freeze([...weightNames]);
    this.map = Object.freeze(Object.fromEntries(Array.from(nameOf, ([weight, name]) => [weight, places.get(name)])));
    this.#names = Array.from(nameOf.values());
    this.#from = Uint32Array.from(nameOf.keys(), (weight) => weightNames.indexOf(weight));
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

/** For each degree of similarity, the names of a model by their form in this degree. */
function formsIn(names) {
  const degrees = [];
  for (const name of names) {
    formsOf(name).forEach((form, degree) => {
      const byForm = (degrees[degree] ??= new Map());
      if (form !== "" && !byForm.has(form)) byForm.set(form, name);
    });
  }
  return degrees;
}

/** The most similar name for each weight that has one. */
function namesFor(weightNames, degrees, also = {}) {
  const names = new Map();
  for (const weight of weightNames) {
    // A rig may have a prefix that the model lacks, so the bare weight comes last.
    const known = [...[weight, ...(also[weight] ?? [])].map(lettersOf), formsOf(weight).at(BARE)];
    for (const byForm of degrees) {
      const form = known.find((form) => byForm.has(form));
      if (form === undefined) continue;
      names.set(weight, byForm.get(form));
      break;
    }
  }
  return names;
}

/** The kind of which a model has the most shapes of the mouth. */
function recognised(degrees) {
  let best = { kind: undefined, weightNames: [], nameOf: new Map() };
  let most = 0;
  for (const [kind, { mouth, rest, also }] of Object.entries(KINDS)) {
    const count = namesFor(mouth, degrees, also).size;
    if (count <= most) continue;
    most = count;
    const weightNames = [...mouth, ...rest];
    best = { kind, weightNames, nameOf: namesFor(weightNames, degrees, also) };
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
