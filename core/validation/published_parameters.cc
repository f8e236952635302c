#include "core/validation/published_parameters.h"

#include <algorithm>

namespace gaitmill {

const std::vector<PublishedParameters>& publishedParameters() {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  // muscle, volume of, fibers of, force [N], fiber length [cm], slack length [cm], pennation [deg]
  static const std::vector<PublishedParameters> table = {
      {"addbrev", "addbrev", "addbrev", {626, 130}, {10.3, 1.4}, {3.5, 1.7}, {6.6, 3.4}},
      {"addlong", "addlong", "addlong", {917, 220}, {10.8, 2.0}, {13.2, 2.6}, {7.9, 3.9}},
      {"addmagDist", "addmag", "addmag", {597, 131}, {17.7, 3.4}, {8.7, 3.5}, {11.2, 5.5}},
      {"addmagIsch", "addmag", "addmag", {597, 131}, {15.6, 3.0}, {21.6, 3.2}, {9.6, 4.7}},
      {"addmagMid", "addmag", "addmag", {597, 131}, {13.8, 2.6}, {4.7, 2.6}, {11.9, 5.8}},
      {"addmagProx", "addmag", "addmag", {597, 131}, {10.6, 2.0}, {4.0, 2.2}, {17.8, 8.7}},
      {"bflh", "bflh", "bflh", {1313, 402}, {9.8, 2.6}, {32.5, 2.8}, {10.1, 4.9}},
      {"bfsh", "bfsh", "bfsh", {557, 158}, {11.0, 2.1}, {10.6, 2.6}, {15.1, 4.5}},
      {"edl", "toe extensors", "edl", {603, 115}, {6.9, 1.1}, {36.9, 1.5}, {12.5, 3.4}},
      {"ehl", "toe extensors", "ehl", {286, 51}, {7.5, 1.1}, {32.7, 1.4}, {11.3, 2.7}},
      {"fdl", "fdl", "fdl", {423, 148}, {4.5, 1.1}, {37.9, 1.1}, {12.9, 4.6}},
      {"fhl", "fhl", "fhl", {908, 273}, {5.3, 1.3}, {35.4, 1.3}, {14.8, 4.3}},
      {"gaslat", "gaslat", "gaslat", {1575, 404}, {5.9, 1.0}, {37.6, 1.1}, {12.0, 3.3}},
      {"gasmed", "gasmed", "gasmed", {3116, 727}, {5.1, 1.0}, {39.9, 1.1}, {9.5, 4.3}},
      {"glmax1", "glmax", "glmax", {984, 181}, {14.7, 2.4}, {4.9, 4.0}, {20.3, 24.3}},
      {"glmax2", "glmax", "glmax", {1406, 260}, {15.7, 2.6}, {6.8, 4.4}, {21.0, 25.3}},
      {"glmax3", "glmax", "glmax", {948, 175}, {16.7, 2.7}, {7.0, 4.9}, {21.9, 26.3}},
      {"glmed1", "glmed", "glmed", {1093, 279}, {7.3, 1.6}, {5.6, 1.7}, {18.1, 15.2}},
      {"glmed2", "glmed", "glmed", {765, 195}, {7.3, 1.6}, {6.5, 1.7}, {18.1, 15.2}},
      {"glmed3", "glmed", "glmed", {871, 222}, {7.3, 1.6}, {4.5, 1.7}, {18.1, 15.2}},
      {"glmin1", "glmin1", "glmin1", {374, 48}, {6.8, kNone}, {1.6, kNone}, {10.0, kNone}},
      {"glmin2", "glmin2", "glmin2", {395, 59}, {5.6, kNone}, {2.6, kNone}, {0.0, kNone}},
      {"glmin3", "glmin3", "glmin3", {447, 86}, {3.8, kNone}, {5.1, kNone}, {1.0, kNone}},
      {"grac", "grac", "grac", {281, 70}, {22.8, 4.4}, {17.2, 5.5}, {9.9, 3.1}},
      {"iliacus", "iliacus", "iliacus", {1021, 219}, {10.7, 1.9}, {9.6, 2.0}, {16.0, 6.1}},
      {"perbrev", "peroneals", "perbrev", {521, 109}, {4.5, 0.7}, {14.8, 0.8}, {11.8, 3.2}},
      {"perlong", "peroneals", "perlong", {1115, 220}, {5.1, 0.6}, {33.2, 0.8}, {14.2, 5.3}},
      {"piri", "piri", "piri", {1030, 287}, {2.6, kNone}, {11.5, kNone}, {10.0, kNone}},
      {"psoas", "psoas", "psoas", {1427, 306}, {11.7, 1.7}, {10.0, 2.2}, {12.3, 3.9}},
      {"recfem", "recfem", "recfem", {2192, 473}, {7.6, 1.3}, {44.8, 1.4}, {12.4, 3.5}},
      {"sart", "sart", "sart", {249, 43}, {40.3, 4.6}, {12.4, 5.9}, {1.5, 2.1}},
      {"semimem", "semimem", "semimem", {2201, 645}, {6.9, 1.8}, {34.8, 2.1}, {14.6, 3.6}},
      {"semiten", "semiten", "semiten", {591, 148}, {19.3, 4.1}, {24.7, 5.2}, {13.8, 5.4}},
      {"soleus", "soleus", "soleus", {6195, 1606}, {4.4, 1.0}, {27.7, 1.0}, {21.9, 8.0}},
      {"tfl", "tfl", "tfl", {411, 125}, {9.5, kNone}, {44.9, kNone}, {3.0, kNone}},
      {"tibant", "tibant", "tibant", {1227, 205}, {6.8, 0.8}, {24.0, 1.0}, {11.2, 3.7}},
      {"tibpost", "tibpost", "tibpost", {1730, 358}, {3.8, 0.5}, {28.1, 0.7}, {13.0, 4.2}},
      {"vasint", "vasint", "vasint", {1697, 437}, {9.9, 2.0}, {20.2, 2.3}, {3.6, 3.7}},
      {"vaslat", "vaslat", "vaslat", {5149, 1025}, {9.9, 1.8}, {22.1, 1.9}, {14.5, 5.7}},
      {"vasmed", "vasmed", "vasmed", {2748, 701}, {9.7, 2.3}, {20.0, 2.8}, {24.2, 7.6}},
  };
  return table;
}

const PublishedParameters* findPublished(const std::string& base) {
  const std::vector<PublishedParameters>& table = publishedParameters();
  const auto row = std::find_if(
      table.begin(), table.end(), [&base](const auto& one) { return one.muscle == base; });
  return row == table.end() ? nullptr : &*row;
}

}  // namespace gaitmill
