// Two layouts run side by side in step: neither gets ahead of the other, so that both show the same moment.
import { asFastAsItCan } from './transport.mjs';

const lead = 1 / 25;     // s that one may be ahead: a picture or so
const fastLead = 0.5;    // s, where both run as fast as they can

function reached({ status, frame }) {
  return ['opening', 'changed'].includes(status) ? 0 : frame?.time_s ?? 0;
}

/** The time (s) that a run at `pace` may reach beside another in the state `other` of its course. */
export function limitBeside(other, pace) {
  return ['ended', 'failed'].includes(other.status) ? Infinity : reached(other) + (pace === asFastAsItCan ? fastLead : lead);
}

/** Holds the courses of [{ course, pace }] in step, one or two of them; one alone is free. */
export function holdInStep(all) {
  all.forEach(({ course, pace }, k) => {
    const [other] = all.filter((_, i) => i !== k);
    course.limit(other ? limitBeside(other.course.state, pace) : Infinity);
  });
}
