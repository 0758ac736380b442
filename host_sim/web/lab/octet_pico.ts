/* The page of `tools/octet page --pico`, which also runs the flash image of a Pico. */

import { byId } from "../core/dom.js";
import { LabPage } from "./lab_page.js";
import { PicoPanel } from "./pico_panel.js";

const parts = JSON.parse(byId("parts").textContent ?? "");
const octet = new LabPage(parts);
Object.assign(window, { octet, pico: new PicoPanel(octet, parts.pico) });
