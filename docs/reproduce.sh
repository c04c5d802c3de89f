#!/usr/bin/env bash
# Every table of docs/math/estimate-results.md, from nothing but the program: motions and rigs are written here, the
# recordings simulated, the estimates compared with their truth.
#
#   docs/reproduce.sh [convergence] [nominal] [paper] [start] [cameras] [reference] [twin] [coverage] [real]   default: all
#
# VISPLINE: the program. OUT: folder for recordings and results. SEEDS: how many draws of each. TWINS: runs of twin. DRAWS: of
# the table of coverage.
# REAL: folder with noncommercial/tumvi_calib_imu1_first31s; without it there are no tables of real data.
set -euo pipefail
cd "$(dirname "$0")/.."
VISPLINE=$(realpath "${VISPLINE:-build/release/vispline}")
OUT=${OUT:-out/reproduce}
SEEDS=${SEEDS:-5}
TWINS=${TWINS:-200}
DRAWS=${DRAWS:-200}
REAL=${REAL:-}
ALL="convergence nominal paper start cameras reference twin coverage real"

# motion SEED DURATION_S "frequencies [Hz]" "position amplitudes [m]" "rotation amplitudes [rad]": poses (TUM) every
# ms of sums of sinusoids, with phases drawn from the seed. Amplitudes of the tones fall as f^-0.7. The simulator's spline
# goes through the poses; poses every 5 ms would leave 5e-4 m/s^2 at its knots, which the table without noise would show.
motion() {
  awk -v seed="$1" -v T="$2" -v fs="$3" -v ps="$4" -v rs="$5" 'BEGIN {
    srand(seed); n = split(fs, f, " "); split(ps, pa, " "); split(rs, ra, " "); sum = 0; tau = 6.283185307179586
    for (k = 1; k <= n; ++k) sum += f[k]^-0.7
    for (a = 1; a <= 3; ++a) for (k = 1; k <= n; ++k) { pp[a, k] = tau * rand(); rp[a, k] = tau * rand() }
    for (i = -200; i <= (T + 0.2) * 1000; ++i) {
      t = i / 1000
      for (a = 1; a <= 3; ++a) {
        p[a] = 0; r[a] = 0
        for (k = 1; k <= n; ++k) {
          w = f[k]^-0.7 / sum
          p[a] += pa[a] * w * sin(tau * f[k] * t + pp[a, k]); r[a] += ra[a] * w * sin(tau * f[k] * t + rp[a, k])
        }
      }
      th = sqrt(r[1]^2 + r[2]^2 + r[3]^2); s = th < 1e-9 ? 0.5 : sin(th / 2) / th
      printf "%.9f %.15g %.15g %.15g %.15g %.15g %.15g %.15g\n", 10 + t, p[1], p[2], p[3], s*r[1], s*r[2], s*r[3], cos(th/2)
    }
  }'
}
# board STEP CURVED: every so many points of a grid of 19 x 10, 25.45 cm wide, 45 cm in front (along y).
board() {
  awk -v step="$1" -v curved="$2" 'BEGIN {
    L = 0.2545; id = 0
    for (j = 0; j < 10; ++j) for (i = 0; i < 19; ++i) {
      if ((j * 19 + i) % step) continue
      x = (i / 18 - 0.5) * L
      printf "%d,%.9f,%.9f,%.9f\n", id++, x, 0.45 + (curved ? 0.05 * sin(6.283185307179586 * x / L) : 0), (j / 9 - 0.5) * L * 0.5
    }
  }'
}
imu() { # NAME RATE GYRO_SIGMA ACCEL_SIGMA BIAS(1: true, 0: start)
  awk -v name="$1" -v rate="$2" -v g="$3" -v a="$4" -v b="$5" 'BEGIN {
    printf "  %s:\n    rate_hz: %s\n", name, rate
    printf "    gyroscope: {noise_density: %.9g, random_walk: 1.0e-9, bias: [%s]}\n", g / sqrt(rate), b ? "0.01, -0.02, 0.015" : "0.0, 0.0, 0.0"
    printf "    accelerometer: {noise_density: %.9g, random_walk: 1.0e-9, bias: [%s]}\n", a / sqrt(rate), b ? "0.08, -0.05, 0.1" : "0.0, 0.0, 0.0"
  }'
}
# camera NAME RATE FOCAL "cx, cy" PIXEL_SIGMA LINE_DELAY OFFSET "rotation vector off, rad" "translation off, m"
# frame c of the truth: z along y of the body, x right, y down, turned by (0.05, -0.04, 0.08) rad.
camera() {
  awk -v name="$1" -v rate="$2" -v f="$3" -v c="$4" -v px="$5" -v ld="$6" -v off="$7" -v turn="$8" -v move="$9" '
  function rot(r, R,   th, a, b) {
    th = sqrt(r[1]^2 + r[2]^2 + r[3]^2); a = th < 1e-12 ? 1 : sin(th) / th; b = th < 1e-12 ? 0.5 : (1 - cos(th)) / th^2
    R[1,1] = 1 - b*(r[2]^2+r[3]^2); R[1,2] = b*r[1]*r[2] - a*r[3]; R[1,3] = b*r[1]*r[3] + a*r[2]
    R[2,1] = b*r[1]*r[2] + a*r[3]; R[2,2] = 1 - b*(r[1]^2+r[3]^2); R[2,3] = b*r[2]*r[3] - a*r[1]
    R[3,1] = b*r[1]*r[3] - a*r[2]; R[3,2] = b*r[2]*r[3] + a*r[1]; R[3,3] = 1 - b*(r[1]^2+r[2]^2)
  }
  function mul(A, B, C,   i, j, k) { for (i=1;i<=3;++i) for (j=1;j<=3;++j) { C[i,j]=0; for (k=1;k<=3;++k) C[i,j]+=A[i,k]*B[k,j] } }
  BEGIN {
    A[1,1]=1; A[1,2]=0; A[1,3]=0; A[2,1]=0; A[2,2]=0; A[2,3]=-1; A[3,1]=0; A[3,2]=1; A[3,3]=0
    split("0.05 -0.04 0.08", r, " "); rot(r, E); mul(A, E, B)
    split(turn, d, " "); rot(d, D); mul(B, D, R); split(move, m, " "); p[1]=0.02+m[1]; p[2]=-0.05+m[2]; p[3]=0.03+m[3]
    printf "  %s:\n    camera_model: pinhole\n    intrinsics: [%.9g, %.9g, %s]\n    distortion_model: none\n    distortion_coeffs: []\n    resolution: [640, 480]\n    T_cam_imu:\n", name, f, f, c
    for (i=1;i<=3;++i) printf "      - [%.15g, %.15g, %.15g, %.15g]\n", R[i,1], R[i,2], R[i,3], p[i]
    printf "      - [0.0, 0.0, 0.0, 1.0]\n    timeshift_cam_imu: %s\n    line_delay: %s\n    readout: down\n    rate_hz: %s\n    pixel_sigma: %s\n", off, ld, rate, px
  }'
}
head_of_rig() { printf 'vispline_rig: 1\ngravity: [0.0, 0.0, -9.81]\nimus:\n'; }
LD=5.41666667e-5
P_FREQ=".25 .45 .7"; P_POS=".22 .12 .18"; P_ROT=".35 .35 .5"
N_FREQ=".3 .6 1.1"; N_POS=".25 .15 .2"; N_ROT=".45 .45 .6"

# rig FILE IMU_RATE GYRO ACCEL CAMERA_RATE PIXEL: the truth of one camera and one IMU.
rig() {
  { head_of_rig; imu imu0 "$2" "$3" "$4" 1; echo "cameras:"
    camera cam0 "$5" 525 "319.5, 239.5" "$6" $LD 0.0 "0 0 0" "0 0 0"; } > "$1"
}
# poor FILE IMU_RATE GYRO ACCEL CAMERA_RATE PIXEL FOCAL OFFSET ROTATION TRANSLATION LINE_DELAY: what an estimate begins with.
poor() {
  { head_of_rig; imu imu0 "$2" "$3" "$4" 0; echo "cameras:"
    camera cam0 "$5" "$7" "320, 240" "$6" "${11}" "$8" "$9" "${10}"; } > "$1"
}
# record FOLDER SEED DURATION RIG BOARD [FLAG]: the recording D of motion.tum.
record() {
  "$VISPLINE" simulate --trajectory "$1/motion.tum" --start 10 --duration "$3" --rig "$4" --scene "$5" \
    --min-distance 0 --track-loss 0 --max-features 1000 ${6:-} --seed "$2" --out "$1/D" > /dev/null 2> "$1/simulate.log"
}
# estimated FOLDER NAME START FLAGS...: the estimate NAME; its table is FOLDER/NAME.txt. A class that is not trusted is a
# result too.
estimated() {
  local folder=$1 name=$2 start=$3; shift 3
  "$VISPLINE" estimate "$folder/D" --rig "$start" --truth-rig "$folder/truth.yaml" \
    --truth "$folder/D/mav0/state_groundtruth_estimate0/data.csv" --out "$folder/$name" "$@" \
    > "$folder/$name.txt" 2> "$folder/$name.log" || true
}
header() {
  printf '%-34s %-14s %9s %9s %8s %8s %9s %8s %9s %9s %8s %9s %9s\n' what class 'rot[deg]' 'trans[mm]' 'focal[%]' \
    'centre' 'clock[ms]' 'line[%]' 'gyro' 'accel' 'max[sig]' 'rms[px]' 'ATE[mm]'
}
# row LABEL FILE: errors of one estimate. gyro in mrad/s, accel in mm/s^2, centre in px, max: the largest error in sigmas.
row() {
  awk -F'  +' -v label="$1" '
    /^class: / { class = $0; sub(/^class: /, "", class) }
    $1 ~ /^(cam0|imu0)\./ && NF >= 7 { e = $6 * $4; a = $6 < 0 ? -$6 : $6; if (a > worst) worst = a }
    $1 ~ /^cam0.T_c_i.rotation/ { rot += e * e }
    $1 ~ /^cam0.T_c_i.translation/ { trans += e * e }
    $1 ~ /^cam0.intrinsics/ { ++k; if (k == 1) focal = 100 * e / 525; if (k > 2) centre += e * e }
    $1 ~ /^cam0.time_offset/ { clock = e }
    $1 ~ /^cam0.line_delay/ { line = 100 * e / 54.1666667 }
    $1 ~ /^imu0.gyroscope.bias/ { gyro += e * e }
    $1 ~ /^imu0.accelerometer.bias/ { accel += e * e }
    $1 == "cam0" && NF >= 8 { rms = $3 }
    /^trajectory against the truth/ { ate = $0; sub(/^[^:]*: /, "", ate); sub(/ .*/, "", ate) }
    END { printf "%-34s %-14s %9.4f %9.3f %8.3f %8.3f %9.4f %8.3f %9.3f %9.2f %8.2f %9.4f %9s\n", label, class, sqrt(rot), sqrt(trans),
          focal, sqrt(centre), clock, line, 1e3 * sqrt(gyro), 1e3 * sqrt(accel), worst, rms, ate }' "$2"
}
# fresh NAME: an empty folder of that name.
fresh() { rm -rf "${OUT:?}/$1"; mkdir -p "$OUT/$1"; echo "$OUT/$1"; }

FREE="--free cam0.intrinsics,cam0.line_delay"
P_IMU="100 0.005 0.02" P_CAMERA="30 0.28" N_IMU="200 0.003 0.015" N_CAMERA="15 0.2"

# One recording of data set P: motion, board, truth and a start that is 10 deg, 3 cm and 10 % off, line delay unknown.
paper_data() { # FOLDER SEED STEP CURVED CAMERA_RATE
  motion "$2" 12.86 "$P_FREQ" "$P_POS" "$P_ROT" > "$1/motion.tum"
  board "$3" "$4" > "$1/board.csv"
  rig "$1/truth.yaml" $P_IMU "$5" 0.28
  poor "$1/start.yaml" $P_IMU "$5" 0.28 577.5 0.0 "0.1 -0.1 0.1" "0.02 -0.02 0.01" 0.0
  record "$1" "$2" 12.86 "$1/truth.yaml" "$1/board.csv"
}
# One recording of data set N: the start is 5 deg, 5 cm, 20 ms and 2 % off, line delay unknown.
nominal_data() { # FOLDER SEED
  motion "$2" 25 "$N_FREQ" "$N_POS" "$N_ROT" > "$1/motion.tum"
  board 3 0 > "$1/board.csv"
  rig "$1/truth.yaml" $N_IMU $N_CAMERA
  poor "$1/start.yaml" $N_IMU $N_CAMERA 535.5 0.02 "0.0504 -0.0504 0.0504" "0.0289 -0.0289 0.0289" 0.0
  record "$1" "$2" 25 "$1/truth.yaml" "$1/board.csv" --keep-ids
}

table_convergence() {
  echo; echo "== row 10: without noise, errors against the spacing of knots (motion N, 10 s)"; header
  local d; d=$(fresh convergence)
  motion 1 10 "$N_FREQ" "$N_POS" "$N_ROT" > "$d/motion.tum"; board 3 0 > "$d/board.csv"
  rig "$d/exact.yaml" 200 1e-9 1e-9 15 1e-6; rig "$d/truth.yaml" $N_IMU $N_CAMERA
  poor "$d/start.yaml" $N_IMU $N_CAMERA 535.5 0.0 "0.05 -0.05 0.05" "0.02 -0.02 0.01" 0.0
  record "$d" 1 10 "$d/exact.yaml" "$d/board.csv"
  for spacing in 0.1 0.05 0.025; do
    estimated "$d" "K$spacing" "$d/start.yaml" $FREE --knot-spacing $spacing --noise rig
    row "knots $spacing s" "$d/K$spacing.txt"
  done
}
table_nominal() {
  echo; echo "== rows 11-13, 21 and the poor start: data set N, everything free, $SEEDS draws"; header
  for s in $(seq "$SEEDS"); do
    local d; d=$(fresh "nominal$s"); nominal_data "$d" "$s"
    estimated "$d" E "$d/start.yaml" $FREE --knot-spacing 0.05
    row "N, draw $s" "$d/E.txt"
  done
}
table_paper() {
  echo; echo "== rows 14-16: data set P, the rolling shutter's model and a global one, $SEEDS draws"; header
  for curved in 0 1; do for s in $(seq "$SEEDS"); do
    local d; d=$(fresh "paper$curved$s"); paper_data "$d" "$s" 3 $curved 30
    local shape=planar; [ $curved = 1 ] && shape=curved
    estimated "$d" R "$d/start.yaml" $FREE --knot-spacing 0.1
    estimated "$d" G "$d/start.yaml" --free cam0.intrinsics --fix cam0.line_delay --knot-spacing 0.1
    row "$shape, draw $s, rolling" "$d/R.txt"; row "$shape, draw $s, global" "$d/G.txt"
  done; done
}
table_start() {
  echo; echo "== row 17: P at 15 Hz, 48 points, focal length 20 % off, camera turned by 5, 20, 45 deg"; header
  for turn in 0.0504 0.2015 0.4534; do for s in $(seq "$SEEDS"); do
    local d; d=$(fresh "start$turn$s"); paper_data "$d" "$((200 + s))" 4 0 15
    poor "$d/start.yaml" $P_IMU 15 0.28 630 0.0 "$turn -$turn $turn" "0.02 -0.02 0.01" 0.0
    estimated "$d" E "$d/start.yaml" $FREE --knot-spacing 0.1
    row "turned by 3 x $turn rad, draw $s" "$d/E.txt"
  done; done
}
table_cameras() {
  echo; echo "== row 18 and two IMUs: rolling 30 Hz, global 24 Hz, IMUs 100 and 200 Hz, no two clocks alike"
  for s in $(seq "$SEEDS"); do
    local d; d=$(fresh "cameras$s")
    motion "$((300 + s))" 12.86 "$P_FREQ" "$P_POS" "$P_ROT" > "$d/motion.tum"; board 3 0 > "$d/board.csv"
    local other="T_b_i: [[0.0, -1.0, 0.0, 0.05], [1.0, 0.0, 0.0, -0.02], [0.0, 0.0, 1.0, 0.03], [0.0, 0.0, 0.0, 1.0]]"
    { head_of_rig; imu imu0 100 0.005 0.02 1; imu imu1 200 0.005 0.02 1 | sed "s/}$/, time_offset: 0.0032, $other}/"
      echo "cameras:"; camera cam0 30 525 "319.5, 239.5" 0.28 $LD 0.0073 "0 0 0" "0 0 0"
      camera cam1 24 481 "322, 236" 0.28 0.0 -0.0041 "0.1 -0.2 0.05" "-0.1 0.06 -0.01"; } > "$d/truth.yaml"
    { head_of_rig; imu imu0 100 0.005 0.02 0; imu imu1 200 0.005 0.02 0
      echo "cameras:"; camera cam0 30 525 "319.5, 239.5" 0.28 $LD 0.0 "0.05 -0.05 0.05" "0.02 -0.02 0.01"
      camera cam1 24 481 "322, 236" 0.28 0.0 0.0 "0.1 -0.2 0.05" "-0.08 0.04 0.0"; } > "$d/start.yaml"
    record "$d" "$s" 12.86 "$d/truth.yaml" "$d/board.csv"
    estimated "$d" E "$d/start.yaml" --free cam0.intrinsics,cam1.intrinsics,cam1.line_delay --knot-spacing 0.1
    echo "-- draw $s"; grep -E '^(class|parameter|cam|imu1)' "$d/E.txt" || cat "$d/E.log"
  done
}
table_reference() {
  echo; echo "== row 22: P at 15 Hz, the reference pixel exact (the paper's landmark) and measured"; header
  for s in $(seq "$SEEDS"); do
    local d; d=$(fresh "reference$s"); paper_data "$d" "$((100 + s))" 3 0 15
    for unknowns in inverse-depth point; do
      estimated "$d" $unknowns "$d/start.yaml" $FREE --knot-spacing 0.1 --landmark-unknowns $unknowns --noise rig
      row "draw $s, $unknowns" "$d/$unknowns.txt"
    done
  done
}
table_twin() {
  echo; echo "== NEES of $TWINS twins of one estimate of P at 15 Hz"
  local d; d=$(fresh twin); paper_data "$d" 2 3 0 15
  estimated "$d" E "$d/start.yaml" $FREE --knot-spacing 0.1 --noise rig --twin "$TWINS"
  grep -iE 'class|twin|nees|cover' "$d/E.txt" || cat "$d/E.log"
}
table_coverage() {
  echo; echo "== P at 15 Hz from the poor start of N, $DRAWS draws of everything: how many errors lie within 1.96 sigma"
  for s in $(seq "$DRAWS"); do
    local d; d=$(fresh "coverage$s"); paper_data "$d" "$((1000 + s))" 3 0 15
    poor "$d/start.yaml" $P_IMU 15 0.28 535.5 0.02 "0.0504 -0.0504 0.0504" "0.0289 -0.0289 0.0289" 0.0
    estimated "$d" E "$d/start.yaml" $FREE --knot-spacing 0.1
    rm -rf "$d/D" "$d/motion.tum" "$d/E"
  done
  awk -F'  +' '
    /^class: / { class = substr($0, 8); ++runs[class] }
    class ~ /^converged/ && /^against the truth: NEES/ { split($0, w, " "); nees += w[5]; numbers = w[7]; ++all }
    class ~ /^converged/ && /^(cam0\.|imu0\..*bias)/ && NF >= 7 { ++n[$1]; s[$1] += $6 * $6; within[$1] += $6 * $6 < 3.8416; if ($6 * $6 > 9) ++far }
    END {
      for (c in runs) printf "%s: %d\n", c, runs[c]
      for (k in n) { printf "%-26s in 95 %%: %5.1f %%   rms %.2f sigma\n", k, 100 * within[k] / n[k], sqrt(s[k] / n[k]); a += within[k]; b += n[k]; q += s[k] }
      if (all) printf "NEES of %d numbers: %.3f, right sigmas give 1 +- %.3f (one sigma)\n", numbers, nees / all, sqrt(2 / (numbers * all))
      printf "all parameters: in 95 %%: %.1f %%, mean square %.3f, beyond 3 sigma %.2f %%\n", 100 * a / b, q / b, 100 * far / b
    }' "$OUT"/coverage*/E.txt
}
table_real() {
  local d=$REAL/noncommercial/tumvi_calib_imu1_first31s
  if [ -z "$REAL" ] || [ ! -d "$d" ]; then echo; echo "== real data: skipped, REAL is not given"; return; fi
  echo; echo "== TUM-VI calib-imu1, first 31 s"
  "$VISPLINE" calibrate "$d/imu0.csv.xz" --rig "$d/initial_calibration.json" --target "$d/corners3D.csv" \
    --corners "cam0=$d/corners2D_cam0.csv.xz" --corners "cam1=$d/corners2D_cam1.csv.xz" \
    --truth "$d/mocap0_imu_pose.csv.xz" --out "$(fresh real)/calib" || true
}

for table in ${@:-$ALL}; do
  [[ " $ALL " == *" $table "* ]] || { echo "no table $table; there are: $ALL" >&2; exit 2; }
  "table_$table"
done
