// Sliders at the left, what Python answers at the right. The next values are sent when the last answer has come.

function slider(quantity, moved) {
  const log = quantity.scale === "log";
  const row = document.createElement("label");
  const name = document.createElement("span");
  const input = document.createElement("input");
  const shown = document.createElement("output");
  const [from, to] = log ? [Math.log(quantity.from), Math.log(quantity.to)] : [quantity.from, quantity.to];
  const place = (value) => (log ? Math.log(value) : value);
  name.textContent = quantity.path;
  Object.assign(input, { type: "range", min: from, max: to, step: (to - from) / 200 });
  input.value = quantity.value === "inf" ? to : place(quantity.value);
  const tell = (value) => (shown.textContent = value === "inf" ? "rigid" : `${+value.toPrecision(4)} ${quantity.unit}`);
  tell(quantity.value);
  input.addEventListener("input", () => {
    const value = log ? Math.exp(input.valueAsNumber) : input.valueAsNumber;
    tell(value);
    moved(quantity.path, value);
  });
  row.append(name, input, shown);
  return row;
}

function render({ model, el }) {
  const sliders = document.createElement("div");
  const answer = document.createElement("div");
  let wanted = model.get("values");
  let sent = JSON.stringify(wanted);
  let waiting = false;
  const send = () => {
    waiting = JSON.stringify(wanted) !== sent;
    if (!waiting) return;
    sent = JSON.stringify(wanted);
    model.set("values", wanted);
    model.save_changes();
  };
  const moved = (path, value) => {
    wanted = { ...wanted, [path]: value };
    if (!waiting) send();
  };
  const show = () => {
    answer.innerHTML = model.get("answer").html; // made by Python, with every name escaped
  };
  const answered = () => {
    show();
    send();
  };
  sliders.className = "sliders";
  sliders.append(...model.get("quantities").map((quantity) => slider(quantity, moved)));
  el.classList.add("beal", "explorer");
  el.append(sliders, answer);
  answer.setAttribute("aria-live", "polite");
  show();
  model.on("change:answer", answered);
  return () => model.off("change:answer", answered);
}

export default { render };
