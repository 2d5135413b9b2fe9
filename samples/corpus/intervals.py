"""Confidence intervals of errors, and of differences between methods, from sums over blocks of an image."""
import math

import numpy as np

NORMAL_QUANTILE = 1.959964
"""Of 97.5 %, so that all intervals are of 95 %."""
FEWEST_BLOCKS = 5


def log_ratio_interval(pairs):
    """Estimate and 95 % confidence interval of the mean, over sequences, of log(sum of p / sum of q).

    pairs: for every sequence the two arrays p and q, with one value per block. A block is a square of the image in all frames:
        neighbouring pixels, and the same place in successive frames, are correlated; squares are taken as independent.
    All that is reported has this form. With p the squared errors of a method and q the numbers of pixels, half the result is
    the log of its RMSE; with q the squared errors of another method on the same blocks, it is the log of the ratio of the two.

    The standard error is the jackknife's (Efron and Tibshirani 1993, 11.5), which leaves out one block at a time. It is multiplied
    by Student's quantile. Its degrees of freedom are the effective number of blocks, less one: 1 / sum(w^2), with the shares w of the
    blocks in the sums. Error is so unevenly spread that a few blocks may hold most of it; with the number of all blocks, or with
    quantiles of a bootstrap, a difference of zero would be taken for one in up to 20 % of cases.
    Returns (estimate, lower, upper), or None if a sum is not above 0 or a sequence has fewer than 5 blocks.
    """
    estimate, variance, spread = 0.0, 0.0, 0.0
    for p, q in pairs:
        counted = np.asarray(q, float) != 0
        p, q = np.asarray(p, float)[counted], np.asarray(q, float)[counted]
        blocks = len(p)
        left_p, left_q = p.sum() - p, q.sum() - q
        if blocks < FEWEST_BLOCKS or min(p.sum(), q.sum()) <= 0 or min(left_p.min(), left_q.min()) <= 0:
            return None
        without = np.log(left_p / left_q)
        square = (blocks - 1) / blocks * ((without - without.mean()) ** 2).sum()
        share = (p / p.sum() + q / q.sum()) / 2
        freedom = max(1 / (share**2).sum() - 1, 2.0)
        estimate += math.log(p.sum() / q.sum()) / len(pairs)
        variance += square / len(pairs) ** 2
        spread += (square / len(pairs) ** 2) ** 2 / freedom
    # Over several sequences the degrees of freedom are those of Welch and Satterthwaite.
    reach = student_quantile(variance**2 / spread) * math.sqrt(variance) if spread > 0 else 0.0
    return estimate, estimate - reach, estimate + reach


def student_quantile(freedom):
    """The 97.5 % quantile of Student's distribution, by the expansion of Abramowitz and Stegun 1964, 26.7.5; 3 % low at 2."""
    z = NORMAL_QUANTILE
    return (z + (z**3 + z) / 4 / freedom + (5 * z**5 + 16 * z**3 + 3 * z) / 96 / freedom**2 +
            (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384 / freedom**3)
