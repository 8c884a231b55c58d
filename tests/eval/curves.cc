#include "tests/eval/curves.h"

#include <string>

#include "tests/eval/figure_3_10.h"
#include "tests/eval/figure_3_13.h"
#include "tests/eval/figure_3_4.h"
#include "tests/eval/figure_3_5.h"
#include "tests/eval/figure_3_6.h"
#include "tests/eval/figure_3_7.h"
#include "tests/eval/figure_3_8.h"
#include "tests/eval/figure_3_9.h"
#include "tests/eval/page.h"

namespace haarmony::eval {

std::vector<OutputFile> make_curve_figures() {
    const Figure310 compressed = measure_figure_3_10();
    const std::string introduction =
        paragraph(
            "The figures of chapter 3 of the dissertation with curves of our own: "
            "strokes "
            "made by code and the built-in characters. Every number is computed when the "
            "page is made. Curves are drawn as the Bezier segments that they are.") +
        paragraph(
            "Unless said otherwise lengths are those of a page about 1000 wide; u runs "
            "from "
            "0 at one end of a curve to 1 at the other.");
    return {{"curves.html",
             page("Multiresolution curves: the figures",
                  introduction,
                  {{"figure-3-4",
                    "Figure 3.4: smoothing, continuously",
                    to_html(measure_figure_3_4())},
                   {"figure-3-5",
                    "Figure 3.5: another sweep, the same character",
                    to_html(measure_figure_3_5())},
                   {"figure-3-6",
                    "Figure 3.6: editing at integer and fractional levels",
                    to_html(measure_figure_3_6())},
                   {"figure-3-7",
                    "Figure 3.7: editing a portion of wanted length",
                    to_html(measure_figure_3_7())},
                   {"figure-3-8",
                    "Figure 3.8: the same sweep, other characters",
                    to_html(measure_figure_3_8())},
                   {"figure-3-9",
                    "Figure 3.9: the orientation of detail",
                    to_html(measure_figure_3_9())},
                   {"figure-3-10",
                    "Figure 3.10: scan conversion at four sizes",
                    sizes_html(compressed)},
                   {"figure-3-11",
                    "Figure 3.11: the same curves at constant size",
                    constant_size_html(compressed)},
                   {"figure-3-13",
                    "Figure 3.13: thickness carried along",
                    to_html(measure_figure_3_13())}})},
            {"curves_approximation.csv", to_csv(compressed).text()}};
}

}  // namespace haarmony::eval
