#include "core/intake/marker_name_sets.h"

#include "core/intake/landmarks.h"

namespace gaitmill {

namespace {

/// "@" stands for the letter of the side in both.
struct Row {
  const char* name;
  const char* landmark;
};

struct Table {
  const char* name;
  const char* description;
  std::vector<Row> rows;
};

// One line a region of the body.
// clang-format off
std::vector<Row> listPlugInGait() {
  return {
      {"@FHD", "@FHD"}, {"@BHD", "@BHD"},
      {"C7", "C7"}, {"T10", "T10"}, {"CLAV", "CLAV"}, {"STRN", "XIPH"}, {"RBAK", "RSCA"}, {"RBAC", "RSCA"},
      {"@SHO", "@ACR"}, {"@UPA", "@UPA"}, {"@ELB", "@LEL"}, {"@FRM", "@FRM"}, {"@WRA", "@FAradius"},
      {"@WRB", "@FAulna"}, {"@FIN", "@FIN"},
      {"@ASI", "@ASI"}, {"@PSI", "@PSI"}, {"SACR", "SACR"},
      {"@THI", "@THI"}, {"@KNE", "@LFC"}, {"@TIB", "@TIB"}, {"@ANK", "@LMAL"}, {"@HEE", "@CAL"}, {"@TOE", "@MT2"},
      // Calibration: medial markers and the knee alignment device.
      {"@MED", "@MMAL"}, {"@MKNE", "@MFC"}, {"@KAX", "@KAX"}, {"@KD1", "@KD1"}, {"@KD2", "@KD2"}};
}

std::vector<Row> add(std::vector<Row> rows, const std::vector<Row>& more) {
  for (const Row& row : more) {
    for (Row& old : rows) {
      if (std::string(old.name) == row.name) {
        old.landmark = nullptr;
      }
    }
    rows.push_back(row);
  }
  return rows;
}

std::vector<Row> listCgm23() {
  return add(listPlugInGait(),
             {{"@KNM", "@MFC"}, {"@THAP", "@THAP"}, {"@THAD", "@THAD"}, {"@TIAP", "@TIAP"}, {"@TIAD", "@TIAD"}});
}

std::vector<Table> listTables() {
  return {
      {"rajagopal2016",
       "markers of Rajagopal2016, the laboratory of Hamner & Delp 2013 (simtk.org/projects/full_body)",
       {{"@ASI", "@ASI"}, {"@PSI", "@PSI"}, {"@HJC", "@HJC"}, {"@KJC", "@KJC"}, {"@AJC", "@AJC"},
        {"@TH1", "@TH1"}, {"@TH2", "@TH2"}, {"@TH3", "@TH3"}, {"@LFC", "@LFC"}, {"@MFC", "@MFC"},
        {"@TB1", "@TB1"}, {"@TB2", "@TB2"}, {"@TB3", "@TB3"}, {"@LMAL", "@LMAL"}, {"@MMAL", "@MMAL"},
        {"@CAL", "@CAL"}, {"@TOE", "@TOE"}, {"@MT5", "@MT5"},
        {"C7", "C7"}, {"CLAV", "CLAV"}, {"@ACR", "@ACR"}, {"@ASH", "@ASH"}, {"@PSH", "@PSH"},
        {"@SJC", "@SJC"}, {"@EJC", "@EJC"}, {"@UA1", "@UA1"}, {"@UA2", "@UA2"}, {"@UA3", "@UA3"},
        {"@LEL", "@LEL"}, {"@MEL", "@MEL"}, {"@FAsuperior", "@FAsuperior"}, {"@FAradius", "@FAradius"},
        {"@FAulna", "@FAulna"}, {"@_tibial_plateau", ""}}},
      {"stanford_walk",
       "walking trial of Rajagopal et al. 2016: clusters on plates, medial and computed points in the static trial",
       {{"@.Shoulder", "@ACR"}, {"@.Clavicle", "@CLV"}, {"@.Biceps", "@BIC"}, {"@.Elbow", "@LEL"},
        {"@.MElbow", "@MEL"}, {"@.Forearm", "@FRM"}, {"@.Wrist", "@WRI"}, {"Head", "TOPH"},
        {"@.ASIS", "@ASI"}, {"@.PSIS", "@PSI"}, {"S2", "S2"}, {"@_HJC", "@HJC"},
        {"@.TH1", "@TH1"}, {"@.TH2", "@TH2"}, {"@.TH3", "@TH3"}, {"@.TH4", "@TH4"},
        {"@.Knee", "@LFC"}, {"@.MKnee", "@MFC"}, {"@.KneeJoint", "@FCmid"},
        {"@.SH1", "@TB1"}, {"@.SH2", "@TB2"}, {"@.SH3", "@TB3"}, {"@.SH4", "@TB4"},
        {"@.Ankle", "@LMAL"}, {"@.MAnkle", "@MMAL"}, {"@.AnkleJoint", "@MALmid"},
        {"@.AnkleJointGround", "@MALfloor"},
        {"@.Heel", "@CAL"}, {"@.MT5", "@MT5"}, {"@.Toe", "@TIP"},
        {"@.HeelGround", "@CALfloor"}, {"@.MT5Ground", "@MT5floor"}, {"@.ToeGround", "@TIPfloor"},
        {"MidASIS", "ASImid"}, {"MidPSIS", "PSImid"}, {"MidClavicle", "CLVmid"}}},
      {"hamner2010",
       "Hamner et al. 2010 and the gait2354 example of OpenSim, with the markers of that model",
       {{"@.ASIS", "@ASI"}, {"V.Sacral", "SACR"},
        {"@.Thigh.Upper", "@TH1"}, {"@.Thigh.Front", "@TH2"}, {"@.Thigh.Rear", "@TH3"},
        {"@.Knee.Lat", "@LFC"}, {"@.Knee.Med", "@MFC"},
        {"@.Shank.Upper", "@TB1"}, {"@.Shank.Front", "@TB2"}, {"@.Shank.Rear", "@TB3"},
        {"@.Ankle.Lat", "@LMAL"}, {"@.Ankle.Med", "@MMAL"},
        {"@.Heel", "@CAL"}, {"@.Midfoot.Sup", "@DFT"}, {"@.Midfoot.Lat", "@B5M"},
        {"@.Toe.Tip", "@TIP"}, {"@.Toe.Lat", "@MT5"}, {"@.Toe.Med", "@MT1"},
        {"Sternum", "STRN"}, {"Clavicle", "CLAV"}, {"C7", "C7"}, {"T10", "T10"},
        {"@.Acromium", "@ACR"}, {"@.Bicep", "@BIC"}, {"@.Elbow", "@LEL"},
        {"@.Wrist.Med", "@FAulna"}, {"@.Wrist.Lat", "@FAradius"}, {"@.Temple", "@TEM"}, {"Top.Head", "TOPH"}}},
      {"plug_in_gait", "Vicon Plug-in Gait, full body (Plug-in Gait Reference Guide); Helen Hayes of Vicon with SACR",
       listPlugInGait()},
      {"helen_hayes",
       "Helen Hayes of Motion Analysis Cortex and OrthoTrak (Kadaba et al. 1990, J Orthop Res 8:383)",
       {{"Top.Head", "TOPH"}, {"Front.Head", "FHDmid"}, {"Rear.Head", "BHDmid"},
        {"@.Shoulder", "@ACR"}, {"@.Offset", "@SCA"}, {"Offset", "RSCA"}, {"@.Elbow", "@LEL"}, {"@.Wrist", "@WRI"},
        {"@.ASIS", "@ASI"}, {"@.PSIS", "@PSI"}, {"V.Sacral", "SACR"},
        {"@.Thigh", "@THI"}, {"@.Knee", "@LFC"}, {"@.Shank", "@TIB"}, {"@.Ankle", "@LMAL"},
        {"@.Heel", "@CAL"}, {"@.Toe", "@MT2"},
        {"@.Knee.Medial", "@MFC"}, {"@.Ankle.Medial", "@MMAL"}}},
      {"cgm2.3", "Conventional Gait Model 2.1 to 2.3 (pycgm2.github.io)", listCgm23()},
      {"cgm2.4", "Conventional Gait Model 2.4 and 2.5 (pycgm2.github.io)",
       add(listCgm23(), {{"@SMH", "@MT2"}, {"@FMH", "@MT1"}, {"@VMH", "@MT5"}, {"@TOE", "@DFT"}})},
      {"opencap", "markers that OpenCap computes from video (stanfordnmbl/opencap-core)",
       {{"C7_study", "C7"}, {"@_shoulder_study", "@ACR"}, {"@.ASIS_study", "@ASI"}, {"@.PSIS_study", "@PSI"},
        {"@HJC_study", "@HJC"},
        {"@_thigh1_study", "@TH1"}, {"@_thigh2_study", "@TH2"}, {"@_thigh3_study", "@TH3"},
        {"@_knee_study", "@LFC"}, {"@_mknee_study", "@MFC"},
        {"@_sh1_study", "@TB1"}, {"@_sh2_study", "@TB2"}, {"@_sh3_study", "@TB3"},
        {"@_ankle_study", "@LMAL"}, {"@_mankle_study", "@MMAL"}, {"@_calc_study", "@CAL"},
        {"@_toe_study", "@TOE"}, {"@_5meta_study", "@MT5"},
        {"@_lelbow_study", "@LEL"}, {"@_melbow_study", "@MEL"}, {"@_lwrist_study", "@FAradius"},
        {"@_mwrist_study", "@FAulna"}}},
      {"opencap_laboratory", "the same places measured with cameras (OpenCap validation data)",
       {{"C7", "C7"}, {"@_Shoulder", "@ACR"}, {"@_Sternum", "STRN"}, {"@.ASIS", "@ASI"}, {"@.PSIS", "@PSI"},
        {"@_HJC", "@HJC"}, {"@_HJC_reg", ""},
        {"@_thigh1", "@TH1"}, {"@_thigh2", "@TH2"}, {"@_thigh3", "@TH3"}, {"@_thigh4", "@TH4"},
        {"@_knee", "@LFC"}, {"@_mknee", "@MFC"},
        {"@_sh1", "@TB1"}, {"@_sh2", "@TB2"}, {"@_sh3", "@TB3"}, {"@_sh4", "@TB4"},
        {"@_ankle", "@LMAL"}, {"@_mankle", "@MMAL"}, {"@_calc", "@CAL"}, {"@_toe", "@TOE"}, {"@_5meta", "@MT5"},
        {"@_lelbow", "@LEL"}, {"@_melbow", "@MEL"}, {"@_lwrist", "@FAradius"}, {"@_mwrist", "@FAulna"},
        {"@_bicep", "@BIC"}}},
      {"video_key_points", "key points of OpenPose BODY_25 and HALPE_26 as OpenCap and Pose2Sim write them",
       {{"Nose", "NOSE"}, {"@Eye", "@EYE"}, {"@Ear", "@EAR"}, {"Head", "TOPH"}, {"Neck", "SJCmid"},
        {"@Shoulder", "@SJC"}, {"@Elbow", "@EJC"}, {"@Wrist", "@WJC"},
        {"midHip", "HJCmid"}, {"Hip", "HJCmid"}, {"@Hip", "@HJC"}, {"@Knee", "@KJC"}, {"@Ankle", "@AJC"},
        {"@Heel", "@CAL"}, {"@BigToe", "@HLX"}, {"@SmallToe", "@TO5"}}},
      {"leardini_ior",
       "Istituti Ortopedici Rizzoli: Leardini et al. 2007 and 2011 (Gait Posture 26:560, Clin Biomech 26:562); "
       "OptiTrack and Qualisys templates",
       {{"CV7", "C7"}, {"TV2", "T2"}, {"TV7", "T8"}, {"MAI", "T8"}, {"TV10", "T10"}, {"TV12", "T12"}, {"LV1", "L1"},
        {"LV5", "L5"}, {"SJN", "CLAV"}, {"IJ", "CLAV"}, {"SXS", "XIPH"}, {"PX", "XIPH"},
        {"@CAJ", "@ACR"}, {"@AC", "@ACR"}, {"@SAE", "@ACR"}, {"@HLE", "@LEL"}, {"@HME", "@MEL"},
        {"@RSP", "@FAradius"}, {"@USP", "@FAulna"}, {"@HM2", "@MC2"}, {"@HM5", "@MC5"}, {"@UOA", "@OLE"},
        {"@IAS", "@ASI"}, {"@IPS", "@PSI"}, {"@ICT", "@ILC"},
        {"@FTC", "@GTR"}, {"@GT", "@GTR"}, {"@FLE", "@LFC"}, {"@LE", "@LFC"}, {"@FME", "@MFC"}, {"@ME", "@MFC"},
        {"@FAX", "@FIB"}, {"@HF", "@FIB"}, {"@TTC", "@TTU"}, {"@TT", "@TTU"},
        {"@FAL", "@LMAL"}, {"@LM", "@LMAL"}, {"@TAM", "@MMAL"}, {"@MM", "@MMAL"},
        {"@FCC", "@CAL"}, {"@CA", "@CAL"}, {"@FM1", "@MT1"}, {"@FM", "@MT1"}, {"@FM2", "@MT2"}, {"@SM", "@MT2"},
        {"@FM5", "@MT5"}, {"@VM", "@MT5"}, {"@FT2", "@TIP"}, {"@FT3", "@TIP"}}},
      {"human_body_model", "Motek Human Body Model (van den Bogert et al. 2013, Med Biol Eng Comput 51:1069)",
       {{"T10", "T10"}, {"C7", "C7"}, {"SACR", "SACR"}, {"NAVE", "NAVE"}, {"XYPH", "XIPH"},
        {"STRN", "CLAV"}, {"BBAC", "RSCA"}, {"@SHO", "@ACR"},
        {"@DELT", "@UPA"}, {"@LEE", "@LEL"}, {"@MEE", "@MEL"}, {"@FRM", "@FRM"}, {"@LW", "@FAradius"},
        {"@MW", "@FAulna"}, {"@FIN", "@FIN"}, {"@HEAD", "@TEM"}, {"THEAD", "TOPH"}, {"FHEAD", "FHDmid"},
        {"@ASIS", "@ASI"}, {"@PSIS", "@PSI"}, {"@GTRO", "@GTR"}, {"F@THI", "@THAP"},
        {"@LEK", "@LFC"}, {"@MEK", "@MFC"}, {"@ATI", "@TTU"}, {"@LM", "@LMAL"}, {"@MM", "@MMAL"},
        {"@HEE", "@CAL"}, {"@TOE", "@MT2"}, {"@MT5", "@MT5"}}},
      {"vicon_iq", "older Vicon templates of animation studios and CMU (mocap.cs.cmu.edu)",
       {{"@FHD", "@FHD"}, {"@BHD", "@BHD"}, {"C7", "C7"}, {"T10", "T10"}, {"CLAV", "CLAV"}, {"STRN", "XIPH"},
        {"RBAC", "RSCA"}, {"RBAK", "RSCA"}, {"@SHO", "@ACR"}, {"@UPA", "@UPA"}, {"@ELB", "@LEL"}, {"@FRM", "@FRM"},
        {"@WRA", "@FAradius"}, {"@WRB", "@FAulna"}, {"@FIN", "@FIN"}, {"@THMB", ""},
        {"@FWT", "@ASI"}, {"@BWT", "@PSI"}, {"@THI", "@THI"}, {"@KNE", "@LFC"}, {"@SHN", "@TIB"},
        {"@ANK", "@LMAL"}, {"@HEE", "@CAL"}, {"@TOE", "@MT2"}, {"@MT1", "@MT1"}, {"@MT5", "@MT5"}}},
      {"sprint", "sprint trials of the nimblephysics data (JA1Gait35.c3d)",
       {{"C7", "C7"}, {"MAN", "CLAV"}, {"T7", "T8"}, {"@SH", "@ACR"}, {"@ARM", "@UPA"}, {"@ELB", "@LEL"},
        {"@FOREARM", "@FRM"}, {"@WR", "@WRI"}, {"@ASI", "@ASI"}, {"SACR", "SACR"}, {"P1", ""}, {"P2", ""},
        {"P3", ""}, {"@THLP", "@TH1"}, {"@THLD", "@TH3"}, {"@THAP", "@THAP"}, {"@THAD", "@THAD"},
        {"@LEPI", "@LFC"}, {"@PAT", "@PAT"}, {"@TIAP", "@TIAP"}, {"@TIAD", "@TIAD"}, {"@TILAT", "@TIB"},
        {"@LMAL", "@LMAL"}, {"@HEEL", "@CAL"}, {"@MFS", "@DFT"}, {"@MFL", "@B5M"}, {"@P1MT", "@MT1"},
        {"@TOE", "@TIP"}, {"@P5MT", "@MT5"}}},
  };
}
// clang-format on

std::string putSide(const std::string& pattern, char side) {
  std::string text = pattern;
  for (char& letter : text) {
    letter = letter == '@' ? side : letter;
  }
  return text;
}

void addMarkers(const Row& row, MarkerNameSet& set) {
  if (row.landmark == nullptr) {
    return;
  }
  const std::string name = row.name;
  if (name.find('@') == std::string::npos) {
    set.markers.push_back({name, row.landmark});
    return;
  }
  for (const char side : {'R', 'L'}) {
    set.markers.push_back({putSide(name, side), putSide(row.landmark, side)});
  }
}

std::vector<MarkerNameSet> makeSets() {
  std::vector<MarkerNameSet> sets;
  for (const Table& table : listTables()) {
    MarkerNameSet set{table.name, table.description, {}};
    for (const Row& row : table.rows) {
      addMarkers(row, set);
    }
    sets.push_back(std::move(set));
  }
  MarkerNameSet own{"landmarks", "the names of the landmarks themselves", {}};
  for (const Landmark& landmark : landmarks()) {
    own.markers.push_back({landmark.name, landmark.name});
  }
  sets.push_back(std::move(own));
  return sets;
}

}  // namespace

const std::vector<MarkerNameSet>& markerNameSets() {
  static const std::vector<MarkerNameSet> sets = makeSets();
  return sets;
}

const MarkerNameSet* findMarkerNameSet(const std::string& name) {
  for (const MarkerNameSet& set : markerNameSets()) {
    if (set.name == name) {
      return &set;
    }
  }
  return nullptr;
}

}  // namespace gaitmill
