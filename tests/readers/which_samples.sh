# To be sourced. Which bodies and avatars the readers get: one of each kind of file, pose and shape, as their
# exports differ in nothing else; all of them with CAPFIT_ALL_SAMPLES=1.
#
#   which_samples FOLDER SUFFIX    prints the files of a folder, one a line
readonly SAMPLE_NAMES="female_average_rest male_heavy_rest child_rest male_muscular_tpose_no_hands_feet_head
  accessories_child armour_man dressed_deleted_centimetres dressed_deleted_quantised dressed_full_woman
  robot_like scan_like skirt_woman"

which_samples() {
  local file name
  for file in "$1"/*."$2"; do
    name=$(basename "$file" ".$2")
    if [ -n "${CAPFIT_ALL_SAMPLES:-}" ] || [[ " ${SAMPLE_NAMES//$'\n'/ } " == *" $name "* ]]; then
      [ ! -e "$file" ] || echo "$file"
    fi
  done
}
