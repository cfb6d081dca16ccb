// A character whose mouth is an image per viseme, or a sheet of images next to each other.

const REST = "-";

/** The images of the codes with a path that has `{code}`, or the sheet before `#` with the codes after it. */
export function spritesOf(path, codes) {
  const [sheet, order] = path.split("#");
  if (order) return { sheet, codes: order };
  const image = (code) => [code, path.replaceAll("{code}", code === REST ? "rest" : code)];
  return { images: Object.fromEntries(codes.map(image)) };
}

export class SpriteDrawing {
  #element;
  #sprites;

  constructor(element) {
    this.#element = element;
  }

  /** Sets the images: `{ images }` by code, or `{ sheet, codes }`; undefined for none. */
  set sprites(sprites) {
    this.#sprites = sprites;
    this.#element.hidden = sprites === undefined;
  }

  get isShown() {
    return this.#sprites !== undefined;
  }

  /** Shows the image of a viseme; that of rest if it is missing. */
  show(viseme) {
    const { images, sheet, codes } = this.#sprites ?? {};
    const { style } = this.#element;
    if (images) {
      style.backgroundImage = `url("${images[viseme] ?? images[REST] ?? Object.values(images)[0]}")`;
      return;
    }
    if (!sheet) return;
    const all = Array.from(codes);
    const index = Math.max(0, all.includes(viseme) ? all.indexOf(viseme) : all.indexOf(REST));
    style.backgroundImage = `url("${sheet}")`;
    style.backgroundSize = `${all.length * 100}% 100%`;
    style.backgroundPosition = `${all.length > 1 ? (index / (all.length - 1)) * 100 : 0}% 0`;
  }
}
