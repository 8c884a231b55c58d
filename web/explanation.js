// Why a picture matches, in numbers: which wavelet coefficients of the query it has and which
// it lacks, with the weight of each bin (section 4.2 of the dissertation).

/** @typedef {{bin: number, weight: number, matched: number, missed: number}} Bin */
/**
 * @typedef {object} Channel
 * @property {string} channel
 * @property {{query: number, target: number, weight: number}} average
 * @property {number} distance
 * @property {Bin[]} bins
 */
/** @typedef {{variant?: string, channels: Channel[], picture?: string}} Explanation */


/**
 * The rows of a channel's table, coarse to fine; a bin that the query has nothing in is left out.
 * @param {Channel} channel
 * @returns {{bin: number, weight: string, matched: number, missed: number}[]}
 */
export function rowsOf({ bins }) {
  return bins
    .filter(({ matched, missed }) => matched + missed > 0)
    .map(({ bin, weight, matched, missed }) => ({ bin, weight: weight.toFixed(2), matched, missed }));
}

/**
 * @param {Explanation} explanation
 * @returns {{matched: number, all: number}}
 */
export function tally({ channels }) {
  const bins = channels.flatMap((channel) => channel.bins);
  const matched = bins.reduce((sum, bin) => sum + bin.matched, 0);
  return { matched, all: bins.reduce((sum, bin) => sum + bin.missed, matched) };
}
