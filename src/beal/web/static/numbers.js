// Numbers as people read them.

export function short(value, digits = 5) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = value.toPrecision(digits);
  if (size >= 1e7 || size < 1e-4) return Number(text).toExponential().replace("e+", "e");
  return String(Number(text));
}

// A quantity by its path, counted from 1 as people do: "joint 1 shear stiffness".
export function named(path) {
  if (path === "stage.split") return "place of joint 1";
  return path.replace(/\[(\d+)\]/g, (_, index) => ` ${Number(index) + 1}`).replaceAll(".", " ").replaceAll("_", " ");
}

export function parsed(text) {
  const value = Number(text.trim());
  return text.trim() !== "" && Number.isFinite(value) ? value : null;
}
