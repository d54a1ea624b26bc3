/** Six short stories: each sets the page and says what to look for. */

export interface Story {
  title: string;
  /** What the page is set to, by the names that programs use. */
  set: Record<string, string | number | boolean>;
  motion: "weave" | "capsize" | "castering" | "kick";
  text: string;
}

const BASE = { bicycle: "stratos", rider: "rider-a", posture: "rigid", torso_lean: false };

export const STORIES: Story[] = [
  {
    title: "Weave",
    set: { ...BASE, speed: 4 },
    motion: "weave",
    text: "Below the weave speed (4.66 m/s here) the bicycle snakes along the road, steer lagging behind lean, and each swing is larger than the last. Drag the speed into the green range: the same motion dies out by itself.",
  },
  {
    title: "Capsize",
    set: { ...BASE, speed: 9.5 },
    motion: "capsize",
    text: "Above the capsize speed the bicycle leans slowly to one side and rides in an ever tighter spiral. It takes many seconds, so a rider hardly notices: look at how small the real part is.",
  },
  {
    title: "Hands on the bar",
    set: { ...BASE, posture: "leaned", arms: "straight", speed: 6 },
    motion: "weave",
    text: "Stretched arms tie the torso to the handlebar: it twists as the bar turns, though the rider does nothing at all. Pin this design, switch to the rigid posture, and see the stable range move to lower speeds.",
  },
  {
    title: "Leaned or upright",
    set: { ...BASE, bicycle: "browser", posture: "upright", speed: 5 },
    motion: "capsize",
    text: "With bent arms and an upright back, the arms' weight holds the handlebar straight: no speed is stable, weave never grows, but capsize always does. Switch to leaned arms and look for the green range.",
  },
  {
    title: "Trail",
    set: { ...BASE, speed: 6, trail: 0.03 },
    motion: "weave",
    text: "Trail is how far the front wheel's contact lies behind the steer axis. Move its slider from 0 to 120 mm: see where weave and capsize speed go, and that more trail is not simply more stability.",
  },
  {
    title: "Why it falls at rest",
    set: { ...BASE, speed: 0.2 },
    motion: "kick",
    text: "Standing still, a bicycle is an inverted pendulum: two real parts are positive, and a push is enough. Raise the speed slowly and watch two of the curves meet: from there on the fall becomes an oscillation.",
  },
];
