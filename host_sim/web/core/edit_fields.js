// @ts-check
/* The changes of a world, as world files have them. */

/** What each change of the world must have: whole numbers and places. */
export const EDIT_FIELDS = new Map([
  ["add_bar", ["a", "b"]], ["move_bar", ["id", "a", "b"]], ["remove_bar", ["id"]], ["move_food", ["id", "at"]],
  ["lift", []], ["put", ["at", "heading"]], ["plant", ["at", "radius"]], ["move_plant", ["id", "at"]],
  ["grow_plant", ["id", "radius"]], ["remove_plant", ["id"]], ["body", []],
]);
