// Runs a page's modules in Node: node run_in_node.js BUNDLE WASM CODE FILE..., where CODE is the body of an asynchronous
// function of (modules, page, texts): the modules of the bundle, the compiled WebAssembly, and what is in the files.
// Prints what it returns as JSON.
const { readFileSync } = require("node:fs");

const AsyncFunction = (async () => {}).constructor;
const [bundle, wasm, code, ...files] = process.argv.slice(2);
const modules = new Function(`${readFileSync(bundle, "utf8")}\nreturn modules;`)();
const page = new WebAssembly.Module(readFileSync(wasm));
const texts = files.map((file) => readFileSync(file, "utf8"));
const run = new AsyncFunction("modules", "page", "texts", code);
run(modules, page, texts).then((result) => console.log(JSON.stringify(result)));
