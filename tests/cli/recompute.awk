# What solve has written, against the physics by brute force: T(θ) = Σ e_s(θ) i_s(θ) + T_cog(θ) in sampled angles and a
# plain Fourier sum. Knows nothing of U. Prints a line for each thing that is wrong.
#   awk -v turns=N -v held=A,RAD -v mean=NM -f recompute.awk machine.csv back_emf.csv cogging.csv target.csv \
#       currents.csv spectrum.csv waveform.csv
# N: electrical turns of a period. held: empty where the plain sine is the one in phase with the back-EMF.

BEGIN {
    FS = ","
    PI = atan2(0, -1)
    s_count = w_count = 0
    tolerance = 1e-9 # A, N·m: sums of some hundred terms of size ten, each good to 1e-15
}

function close_to(x, y) {
    return (x - y < tolerance) && (y - x < tolerance)
}

function wrong(text) {
    print text
    failures++
}

function file_of(path) {
    sub(/.*\//, "", path)
    return path
}

FNR == 1 { file++; header = 1 }
/^#/ { next }
header {
    header = 0
    name[file] = file_of(FILENAME)
    next
}

name[file] == "machine.csv" { value[$1] = $2 }
name[file] == "back_emf.csv" { e_order[++e] = $1; e_size[e] = $2; e_phase[e] = $3 }
name[file] == "cogging.csv" { c_order[++c] = $1; c_size[c] = $2; c_phase[c] = $3 }
name[file] == "target.csv" { t_size[$1 + 0] = $2; t_phase[$1 + 0] = $3 }
name[file] == "currents.csv" { i_order[++i] = $1; i_set[i] = $2; i_size[i] = $3; i_phase[i] = $4 }
name[file] == "spectrum.csv" { for (k = 1; k <= 6; k++) s[s_count, k] = $k; before[s_count, 1] = $7; before[s_count, 2] = $8; s_count++ }
name[file] == "waveform.csv" { for (k = 1; k <= 7; k++) w[w_count, k] = $k; w_count++ }

function emf(phase, angle,   k, sum) {
    sum = 0
    for (k = 1; k <= e; k++)
        sum += e_size[k] * sin(e_order[k] * (angle - 2 * PI * phase / 3) + e_phase[k])
    return sum * value["pole_pairs"] / (2 * PI * value["emf_frequency"])
}

function sequence(k) {
    if (i_set[k] == "neg") return -1
    if (i_set[k] == "sym") return i_order[k] % 3 == 2 ? -1 : i_order[k] % 3
    return 1
}

function current(phase, angle,   k, sum) {
    sum = 0
    for (k = 1; k <= i; k++)
        sum += i_size[k] * sin(i_order[k] * angle - sequence(k) * 2 * PI * phase / 3 + i_phase[k])
    return sum
}

function cogging(angle,   k, sum) {
    sum = 0
    for (k = 1; k <= c; k++) sum += c_size[k] * sin(c_order[k] * angle + c_phase[k])
    return sum
}

# The plain fundamental: the held one, or the least that makes the mean with the back-EMF's (order 1, first row).
function plain(phase, angle) {
    if (held != "") return held_size * sin(angle - 2 * PI * phase / 3 + held_phase)
    return plain_size * sin(angle - 2 * PI * phase / 3 + e_phase[1])
}

function sample(   k, p) {
    for (k = 0; k < N; k++) {
        angle = 2 * PI * turns * k / N
        torque[k] = first[k] = cogging(angle)
        for (p = 0; p < 3; p++) {
            torque[k] += emf(p, angle) * current(p, angle)
            first[k] += emf(p, angle) * plain(p, angle)
        }
    }
}

# Coordinates of an order in found_sine, found_cosine.
function analyse(row, order,   k, factor) {
    found_sine = found_cosine = 0
    factor = (order == 0 ? 1 : 2) / N
    for (k = 0; k < N; k++) {
        found_sine += factor * row[k] * sin(2 * PI * turns * order * k / N)
        found_cosine += factor * row[k] * cos(2 * PI * turns * order * k / N)
    }
}

function compare(what, order, size, phase) {
    if (!close_to(size * cos(phase) * (order > 0), found_sine) || !close_to(size * sin(phase), found_cosine))
        wrong(sprintf("order %g: %s %.12g, %.12g rad; by samples sine %.12g, cosine %.12g", order, what, size, phase, found_sine, found_cosine))
}

function check_spectrum(   k, order) {
    for (k = 0; k < s_count; k++) {
        order = s[k, 1]
        listed[order + 0] = 1
        if (k > 0 && s[k - 1, 1] >= order) wrong("orders do not ascend")
        analyse(torque, order)
        compare("torque", order, s[k, 4], s[k, 5])
        e_s = found_sine
        e_c = found_cosine
        analyse(first, order)
        compare("before", order, before[k, 1], before[k, 2])
        found_sine = found_cosine = 0
        if ((order + 0) in t_size) {
            found_sine = (order > 0) * t_size[order + 0] * cos(t_phase[order + 0])
            found_cosine = order > 0 ? t_size[order + 0] * sin(t_phase[order + 0]) : t_size[0]
        }
        compare("target", order, s[k, 2], s[k, 3])
        error = sqrt((e_s - found_sine) ^ 2 + (e_c - found_cosine) ^ 2)
        if (!close_to(error, s[k, 6])) wrong("order " order ": error " s[k, 6] ", found " error)
        if (error > worst) worst = error
    }
    for (order in t_size) if (!(order in listed)) wrong("wanted order " order " is not in spectrum.csv")
}

# An order that is not listed has no torque: the listed ones make up the whole waveform.
function check_power(   k, sum, listed_sum) {
    for (k = 0; k < N; k++) sum += torque[k] ^ 2 / N
    for (k = 0; k < s_count; k++) listed_sum += s[k, 4] ^ 2 / (s[k, 1] == 0 ? 1 : 2)
    if (!close_to(sum / 100, listed_sum / 100)) wrong("mean square torque " sum ", of the listed orders " listed_sum)
}

function check_waveform(   k, p, angle, sum, d, q) {
    for (k = 0; k < w_count; k++) {
        angle = w[k, 1]
        if (!close_to(angle, 2 * PI * turns * k / w_count)) wrong("waveform row " k ": angle " angle)
        sum = cogging(angle)
        for (p = 0; p < 3; p++) {
            if (!close_to(w[k, 2 + p], current(p, angle))) wrong("waveform row " k ": current of phase " p)
            sum += emf(p, angle) * w[k, 2 + p]
        }
        if (!close_to(w[k, 7], sum)) wrong("waveform row " k ": torque")
        if (!close_to(w[k, 2], w[k, 6] * sin(angle) - w[k, 5] * cos(angle))) wrong("waveform row " k ": i_d, i_q")
        if (!close_to(w[k, 2] + w[k, 3] + w[k, 4], 0)) wrong("waveform row " k ": the currents of a star do not sum to zero")
        if (failures > 20) exit
    }
    if (w_count < 360 * turns) wrong("waveform has " w_count " rows")
}

END {
    if (!e || !i || !s_count || !w_count) wrong("a table is missing")
    split(held, pair, ",")
    held_size = pair[1]
    held_phase = pair[2]
    plain_size = mean / (1.5 * e_size[1] * value["pole_pairs"] / (2 * PI * value["emf_frequency"]))
    N = 400 * turns # above twice the highest order of torque here, so that the sums are exact
    sample()
    check_spectrum()
    check_power()
    check_waveform()
    print "worst", worst + 0 > "/dev/stderr"
    exit failures > 0
}
