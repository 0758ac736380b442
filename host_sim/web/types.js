// @ts-check
/* The shapes of what the server sends and takes. What the fields mean stands where they are made: Message in
   host_sim/live/feed.py, Run in host_sim/report/replay_page.py, the generated ones where generated_types.js says. */

/**
 * @typedef {import("./generated_types.js").Measures} Measures
 * @typedef {import("./generated_types.js").EnvironmentScene} EnvironmentScene
 * @typedef {import("./generated_types.js").State} State
 * @typedef {import("./generated_types.js").Trial} Trial
 * @typedef {import("./generated_types.js").Lesson} Lesson
 */

/**
 * @typedef {Object} Play
 * @property {boolean} playing
 * @property {number} speed
 * @property {boolean} done
 * @property {number} rate
 * @property {boolean} stays
 * @property {boolean} waits
 * @property {Ended | null} ended
 */

/**
 * An environment that has just ended, and all that have since the run was started over.
 * @typedef {Object} Ended
 * @property {number} number
 * @property {boolean} finished
 * @property {number} eaten
 * @property {number} food
 * @property {number} robot_s
 * @property {number} environments
 * @property {number} environments_finished
 * @property {number} environments_robot_s
 */

/**
 * @typedef {Object} Health
 * @property {number} sent
 * @property {number} lost
 * @property {number} refused
 * @property {number} late
 * @property {number} orders_refused
 */

/**
 * Left, right.
 * @typedef {{ volts: number, counts: number[], duty: number[] }} PinFigures
 */

/**
 * What the live page receives; `states` and `trails` have one entry per robot.
 * @typedef {Object} Message
 * @property {Measures} [measures]
 * @property {EnvironmentScene} [environment]
 * @property {number} at
 * @property {State[]} states
 * @property {number[][]} trails
 * @property {Lesson[]} lessons
 * @property {Play} play
 * @property {Health} health
 * @property {PinFigures[]} pins
 * @property {News[]} [news]
 * @property {string[]} [notes]
 * @property {Answer[]} [answers]
 */

/**
 * An answer, and what its facts rest on and speak of: ticks, cells, pieces of food. `log` if each fact in it is known.
 * @typedef {{mark: "log" | "words", text: string, ticks: number[], cells: number[], food: number[]}} Said
 *
 * What a page asked, and the answer: see PageTalk in host_sim/live/page_talk.py.
 * @typedef {{who: string, sentence: string, said: Said, places: WirePlace[]}} Answer
 */

/**
 * What changed in the world or the bodies before a tick, in a sentence.
 * @typedef {[number, string]} News
 */

/** @typedef {"environment" | "change" | "trial" | "lesson" | "boredom" | "eat"} EventKind */

/**
 * What a recorded run has of each robot.
 * @typedef {Object} RobotRun
 * @property {number} node
 * @property {[number, number[]][]} memory
 * @property {[number, Trial | null][]} trials
 * @property {Lesson[]} lessons
 * @property {[number, number, number, number, number][]} cells
 * @property {[number, EventKind][]} events
 * @property {string[]} columns
 * @property {string} data
 */

/**
 * A recorded run.
 * @typedef {Object} Run
 * @property {number} version
 * @property {string} title
 * @property {Measures} measures
 * @property {number} first_tick
 * @property {number} ticks
 * @property {number} [shown] - The tick at which its page opens.
 * @property {[number, EnvironmentScene][]} scenes
 * @property {News[]} [news]
 * @property {[number, number[]][]} eaten
 * @property {RobotRun[]} robots
 */

/**
 * A place in the arena, mm.
 * @typedef {{x: number, y: number}} Place
 */

/**
 * A place as commands have it: whole mm, [x, y].
 * @typedef {[number, number]} WirePlace
 */

/**
 * What the live page sends.
 * @typedef {{do: "play" | "pause" | "decision" | "next"}
 *   | {do: "speed", factor: number}
 *   | {do: "seed", seed: number, keep: number}
 *   | {do: "write", node: number, cell: number, side: number}
 *   | {do: "erase", node: number}
 *   | {do: "freeze", node: number, on: number}
 *   | {do: "ask", who: string, text: string, node: number}
 *   | {do: "add_bar", a: WirePlace, b: WirePlace}
 *   | {do: "move_bar", id: number, a: WirePlace, b: WirePlace}
 *   | {do: "remove_bar", id: number}
 *   | {do: "move_food", id: number, at: WirePlace}
 *   | {do: "plant", at: WirePlace, radius: number}
 *   | {do: "move_plant", id: number, at: WirePlace}
 *   | {do: "grow_plant", id: number, radius: number}
 *   | {do: "remove_plant", id: number}
 *   | {do: "body", what: string, robot: number, seed: number}
 *   | {do: "lift", node: number}
 *   | {do: "put", node: number, at: WirePlace, heading: number}} Command
 */

/**
 * How a robot of an experiment is started.
 * @typedef {Object} RobotSetup
 * @property {string} profile
 * @property {Record<string, number>} settings
 * @property {number[] | null} memory
 * @property {number} [seed] - Of its random turns; by default the experiment's, plus its place among the robots.
 * @property {string} [program] - Its brain, in the language of the listing; without one, the firmware's own.
 */

/**
 * A change of the world, as world files have it.
 * @typedef {{do: "add_bar", a: [number, number], b: [number, number]}
 *   | {do: "move_bar", id: number, a: [number, number], b: [number, number]}
 *   | {do: "remove_bar", id: number}
 *   | {do: "move_food", id: number, at: [number, number]}
 *   | {do: "plant", at: [number, number], radius: number}
 *   | {do: "move_plant", id: number, at: [number, number]}
 *   | {do: "grow_plant", id: number, radius: number}
 *   | {do: "remove_plant", id: number}
 *   | {do: "body", what: string, robot?: number, seed?: number}
 *   | {do: "lift", robot?: number}
 *   | {do: "put", robot?: number, at: [number, number], heading: number}} WorldEdit
 */

/**
 * What a robot is told between two ticks; robots are counted from 0. A start is that of the robot with another behaviour; its
 * memory stays. A command is one as a log has it: `struct command`.
 * @typedef {{do: "write", robot: number, cell: number, side: number}
 *   | {do: "erase", robot: number}
 *   | {do: "freeze", robot: number, on: number}
 *   | {do: "set", robot: number, parameter: string, value: number}
 *   | {do: "start", robot: number, profile: string}
 *   | {do: "command", robot: number, opcode: number, which: number, value: number}} RobotChange
 *
 * What a person changes between two ticks: the world, as in world files, or a robot.
 * @typedef {WorldEdit | RobotChange} Change
 */

/**
 * The dimensions of a world; what its layouts are drawn from, an enum layout_style; and its measures, with the default
 * limit of boredom.
 * @typedef {import("./generated_types.js").SimParams & {style: number, measures: Measures}} SimParams
 *
 * Both ends of an obstacle: ax, ay, bx, by in mm.
 * @typedef {[number, number, number, number]} Bar
 *
 * A round obstacle: x, y and its radius in mm.
 * @typedef {[number, number, number]} Plant
 *
 * x and y in mm, heading in rad.
 * @typedef {[number, number, number]} Pose
 *
 * @typedef {{bars: Bar[], food: [number, number][], starts: Pose[]}} Layout
 */

/**
 * A world that a person wrote, as run.world.json has it: mm, and the start's heading in degrees.
 * @typedef {{name: string, size?: [number, number], start?: [number, number, number], food: [number, number][],
 *   bars: [number, number, number, number][]}} WrittenWorld
 */

/**
 * All that a simulated run depends on. Changes are made before the senses of their tick, and are in the order of ticks.
 * @typedef {Object} Experiment
 * @property {number} seed
 * @property {number} environments
 * @property {number} limit_ticks
 * @property {RobotSetup[]} robots
 * @property {(Change & {tick: number})[]} changes
 * @property {string | WrittenWorld} [world] - Where it takes place; by default, the random one.
 * @property {string | Traits} [body] - What the robots' bodies are like: "ideal", "kit", or as in docs/bodies.md; by default, ideal.
 * @property {number} [ticks_max] - Of a run that was ended early.
 */

/**
 * What bodies are like: of each trait its value and its tolerance.
 * @typedef {Record<string, [number, number]>} Traits
 */
