// Questions to the server. One question of a kind is on its way at a time; of those that wait only the newest is asked.

export class Refused extends Error {
  constructor(problems) {
    super(problems.map(({ path, message }) => (path ? `${path}: ${message}` : message)).join("; "));
    this.problems = problems;
  }
}

export async function ask(name, question, signal) {
  let reply;
  try {
    reply = await fetch(`/api/${name}`, {
      method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(question), signal,
    });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw new Refused([{ path: "", message: "the server does not answer; is beal explore still running?" }]);
  }
  const answer = await reply.json();
  if (!reply.ok) throw new Refused(answer.errors);
  return answer;
}

export async function read(name) {
  return (await fetch(`/api/${name}`)).json();
}

export class Latest {
  #busy = false;
  #next = null;
  took = 0; // ms, of the last answer

  constructor(name, show, refuse) {
    Object.assign(this, { name, show, refuse });
  }

  ask(question) {
    this.#next = question;
    if (!this.#busy) this.#run();
  }

  async #run() {
    this.#busy = true;
    while (this.#next) {
      const question = this.#next;
      this.#next = null;
      const began = performance.now();
      try {
        const answer = await ask(this.name, question);
        this.took = performance.now() - began;
        this.show(answer, question);
      } catch (error) {
        if (!(error instanceof Refused)) {
          this.#busy = false;
          throw error;
        }
        if (!this.#next) this.refuse(error, question);
      }
    }
    this.#busy = false;
  }
}
