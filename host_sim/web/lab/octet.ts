/* The page: shows the run from its source, which is live, recorded or simulated. */

import { byId, setText } from "../core/dom.js";
import { heard } from "../core/language.js";
import { RunData } from "../core/run_data.js";
import { watch } from "../live/live_page.js";
import { LabPage } from "./lab_page.js";

async function start() {
  const [parts, run] = ["parts", "run"].map((id) => JSON.parse(byId(id).textContent || "null"));
  if (parts.live) watch(parts);
  else Object.assign(window, { octet: new LabPage(parts, run ? await RunData.from(run) : undefined) });
}

start().catch((error) => setText(byId("status"), heard(error.message)));
