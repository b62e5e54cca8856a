// What the page shows, as one small object: it can be undone, redone, and put into the address.

const FRESH = { values: {}, choices: {}, formulation: "objective", thrust: null, mode: 0, axes: null, over: "", sensor: "", start: 1, duration: null, further: "" };

export class State {
  #past = [];
  #future = [];
  #kept = "";

  constructor(changed) {
    this.changed = changed;
    this.now = { model: "", ...structuredClone(FRESH) };
  }

  // A change that goes on, such as the drag of a slider; `keep` ends it.
  set(part) {
    Object.assign(this.now, part);
    this.changed(part);
  }

  value(path, value) {
    this.set({ values: { ...this.now.values, [path]: value } });
  }

  keep() {
    const text = JSON.stringify(this.now);
    if (text === this.#kept) return;
    if (this.#kept) this.#past.push(this.#kept);
    this.#kept = text;
    this.#future = [];
    this.#address(text);
    this.changed({});
  }

  open(model) {
    this.set({ model, ...structuredClone(FRESH), formulation: this.now.formulation });
    this.keep();
  }

  reset() {
    this.set({ ...structuredClone(FRESH) });
    this.keep();
  }

  get undoable() { return this.#past.length > 0; }
  get redoable() { return this.#future.length > 0; }
  undo() { this.#step(this.#past, this.#future); }
  redo() { this.#step(this.#future, this.#past); }

  #step(from, to) {
    if (!from.length) return;
    to.push(this.#kept);
    this.#kept = from.pop();
    this.now = JSON.parse(this.#kept);
    this.#address(this.#kept);
    this.changed(this.now);
  }

  async #address(text) {
    const packed = await packedText(text);
    if (text === this.#kept) history.replaceState(null, "", `#${packed}`);
  }

  // The state in the address, if there is one that can be read.
  async fromAddress() {
    const packed = location.hash.slice(1);
    if (!packed) return false;
    try {
      const found = JSON.parse(await unpackedText(packed));
      if (typeof found.model !== "string" || !found.model) return false;
      this.now = { model: "", ...structuredClone(FRESH), ...found };
    } catch {
      return false;
    }
    this.changed(this.now);
    this.keep();
    return true;
  }
}

async function packedText(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join("")).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

async function unpackedText(packed) {
  const bytes = Uint8Array.from(atob(packed.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).text();
}
