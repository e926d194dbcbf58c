-- SPDX-License-Identifier: GPL-3.0-or-later
-- Selections of committed results that several marks use. A mark names them like a file, without quotes.

-- Errors of runs

-- accuracy.csv and accuracy-full.csv of bench/accuracy: all runs, in their order n. `name` is the scene, with its mix
-- if that is not AM1.
CREATE VIEW accuracy_tried AS
SELECT rowid AS n, scene || iif(mix = 'AM1', '', ' with ' || mix) AS name, * FROM "accuracy.csv" UNION ALL
SELECT 1e6 + rowid, scene || iif(mix = 'AM1', '', ' with ' || mix), * FROM "accuracy-full.csv";

-- The runs that succeeded. Runs may fail only where a table shows it: steps beyond the stable one, `tolerance`, and
-- gap_max, which may disconnect the specimen.
CREATE VIEW accuracy_runs AS
SELECT *, error_e_star AS true_e, error_phase_deg AS true_phi, own_error_e_star AS own_e, own_error_phase_deg AS own_phi
FROM accuracy_tried
WHERE CASE WHEN status = 'done' THEN 1
           WHEN study IN ('step_share', 'tolerance') OR gap_max IS NOT NULL THEN 0
           ELSE fail(text('{} of {}, {:g} Hz, scaling {:g}: {}', study, name, frequency_hz, density_scaling,
                          status)) END;

CREATE VIEW accuracy_scaled AS  -- errors at different density scalings, with the settings of most runs
SELECT * FROM accuracy_runs WHERE study = 'front' AND form = 'condensed' AND precision = 'mixed' AND geometry = 'fixed'
AND frequency_hz = 20 AND mix = 'AM1' AND backend = 'cpu';

CREATE VIEW accuracy_steady AS  -- one cycle from the steady start, in double precision
SELECT * FROM accuracy_runs WHERE study IN ('front', 'drift', 'step_share') AND start = 'steady' AND cycles = 1
AND geometry = 'fixed' AND precision = 'double' AND step_share < 1;

CREATE VIEW accuracy_rest AS  -- from rest, with steps below the computed critical one
SELECT * FROM accuracy_runs WHERE study IN ('rest', 'step_share') AND start = 'rest' AND step_share < 1;

CREATE VIEW accuracy_strain AS  -- the longest runs of each scene: in one cycle the second harmonic is still visible
SELECT * FROM accuracy_runs r WHERE study = 'strain' AND geometry = 'updated' AND cycles =
(SELECT max(cycles) FROM accuracy_runs s WHERE s.study = 'strain' AND s.geometry = 'updated' AND s.name = r.name);

CREATE VIEW accuracy_damping AS  -- e, phi: difference from a run with the same start without damping
SELECT r.*, r.true_e - b.true_e AS e, r.true_phi - b.true_phi AS phi FROM accuracy_runs r JOIN (
  SELECT start, true_e, true_phi FROM accuracy_runs
  WHERE study = 'damping' AND scene = 't8' AND mix = 'AM1' AND density_scaling = 1e4 AND damping_kind = 'none'
  UNION ALL SELECT 'steady', true_e, true_phi FROM accuracy_scaled WHERE scene = 't8' AND density_scaling = 1e4) b
ON r.start = b.start WHERE r.study = 'damping' AND r.scene = 't8' AND r.mix = 'AM1' AND r.density_scaling = 1e4;

CREATE VIEW accuracy_tolerance AS  -- achieved: the larger of both errors; off: the same for error − prediction
SELECT *, max(abs(true_e), abs(radians(true_phi))) AS achieved,
  max(abs(true_e - ((1 + true_e) / (1 + own_e) - 1)), radians(abs(own_phi))) AS off,
  iif(seconds_by_hand > 0 AND finite(seconds_by_hand), seconds / seconds_by_hand, NULL) AS over_hand
FROM accuracy_runs WHERE study = 'tolerance';

CREATE VIEW accuracy_kept AS  -- numbers of runs with a tolerance: tried, failed, and within the tolerance
SELECT count(*) AS tried, sum(status <> 'done') AS failed,
  (SELECT sum(achieved <= tolerance) FROM accuracy_tolerance) AS kept FROM accuracy_tried WHERE study = 'tolerance';

CREATE VIEW accuracy_drift AS  -- e, phi: difference from double precision or, for double, from the harmonic solution
SELECT r.*, iif(d.n IS NULL OR r.precision = 'double', r.own_e, r.e_star_pa / d.e_star_pa - 1) AS e,
  iif(d.n IS NULL OR r.precision = 'double', r.own_phi, r.phase_deg - d.phase_deg) AS phi
FROM accuracy_runs r LEFT JOIN (
  SELECT *, max(n) FROM accuracy_runs WHERE study = 'drift' AND precision = 'double'
  GROUP BY name, frequency_hz, density_scaling, cycles, geometry) d
USING (name, frequency_hz, density_scaling, cycles, geometry) WHERE r.study = 'drift';

CREATE VIEW accuracy_single AS  -- all runs in single precision
SELECT name, steps, cycles, e, phi FROM accuracy_drift WHERE precision = 'single' UNION ALL
SELECT name, steps, cycles, own_e, own_phi FROM accuracy_runs
WHERE study = 'tolerance' AND precision = 'single' AND geometry = 'fixed';

CREATE VIEW accuracy_forms AS  -- contact points against condensed contacts, in double precision
SELECT p.e_star_pa / c.e_star_pa - 1 AS e, p.phase_deg - c.phase_deg AS phi FROM accuracy_runs p JOIN accuracy_runs c
USING (study, name, precision, geometry, density_scaling, frequency_hz)
WHERE study = 'front' AND precision = 'double' AND p.form = 'points' AND c.form = 'condensed';

CREATE VIEW accuracy_steps AS  -- fractions of the computed step: the largest stable one, the smallest that failed
SELECT name, min(n) AS n, failed,
  max(iif(status = 'done' AND step_share < coalesce(failed, 99), step_share, NULL)) AS stable
FROM (SELECT *, min(iif(status <> 'done', step_share, NULL)) OVER (PARTITION BY name) AS failed
      FROM accuracy_tried WHERE study = 'step_share') GROUP BY name;

CREATE VIEW accuracy_filters AS  -- contacts dropped and time saved by a filter; e: error of |E*| of the model
SELECT r.name, r.gap_max, r.area_min, 1 - r.contacts / b.contacts AS dropped,
  1 - r.seconds / r.steps / (b.seconds / b.steps) AS saved, r.model_e_star AS e
FROM accuracy_runs r JOIN accuracy_runs b USING (study, name)
WHERE study = 'filter' AND b.gap_max IS NULL AND b.area_min IS NULL;

CREATE VIEW precision_runs AS  -- the larger of both errors, as the program estimates it
SELECT rowid AS n, *, max(abs(e_star), abs(phase_rad)) AS off FROM "precision.csv";

CREATE VIEW stable_limits AS  -- computed step divided by the true limit; usual: for usual specimens only
SELECT measured, iif("case" = 'step_bound' AND quantity = 'computed / true limit', measured, NULL) AS usual
FROM "stability-intel-xeon.csv"
WHERE quantity LIKE '%computed / true limit' AND quantity NOT LIKE 'mean%';

-- The frequency domain

CREATE VIEW linear_pairs AS  -- scenes that ran with the iterative and the direct solver
SELECT i.scene, i.particles, d.solve_s / i.solve_s AS factor,
  max(abs(i.e_star_pa_2 / d.e_star_pa_2 - 1), abs(i.e_star_pa_5 / d.e_star_pa_5 - 1),
      abs(i.e_star_pa_10 / d.e_star_pa_10 - 1), abs(i.e_star_pa_20 / d.e_star_pa_20 - 1)) AS e,
  max(abs(i.phase_deg_2 - d.phase_deg_2), abs(i.phase_deg_5 - d.phase_deg_5),
      abs(i.phase_deg_10 - d.phase_deg_10), abs(i.phase_deg_20 - d.phase_deg_20)) AS phi
FROM "linear-solvers.csv" i JOIN "linear-solvers.csv" d USING (scene)
WHERE i.linear = 'iterative' AND d.linear = 'direct';

CREATE VIEW iteration_counts AS  -- a row per size: without boxes (0), with the solver's choice (1), with 640 (2)
SELECT a.particles, a.contacts, b.boxes, a.iterations AS n0, b.iterations AS n1, c.iterations AS n2,
  a.converged AS ok0, b.converged AS ok1, c.converged AS ok2, a.preconditioner_s + a.solve_s AS s0,
  b.preconditioner_s + b.solve_s AS s1, c.preconditioner_s + c.solve_s AS s2
FROM "iterations.csv" a JOIN "iterations.csv" b ON b.particles = a.particles AND b.boxes BETWEEN 1 AND 639
LEFT JOIN "iterations.csv" c ON c.particles = a.particles AND c.boxes = 640 WHERE a.boxes = 0;

-- Shapes, fillings and voids

CREATE VIEW cubes AS  -- the modulus of an aggregate cube: means and half ranges of three seeds
SELECT *, text('{:.2f} ± {:.2f}', walls, walls_half) AS walls_cell,
  text('{:.2f} ± {:.2f}', gauge, gauge_half) AS gauge_cell
FROM (SELECT spheres, filling, porosity, edge_mm, wall_gpa, sides, avg(number) AS number, avg(poisson) AS poisson,
        avg(walls_gpa) AS walls, (max(walls_gpa) - min(walls_gpa)) / 2 AS walls_half, avg(gauge_gpa) AS gauge,
        (max(gauge_gpa) - min(gauge_gpa)) / 2 AS gauge_half, avg(uniform_strain_gpa) AS uniform
      FROM "aggregate-cube.csv" WHERE seed <= 3 GROUP BY spheres, filling, porosity, edge_mm, wall_gpa, sides);

CREATE VIEW cubes_20 AS  -- cubes of 20 mm without voids between walls of 115.1 GPa, up to twenty seeds
SELECT * FROM "aggregate-cube.csv"
WHERE porosity = 0 AND edge_mm = 20 AND wall_gpa = 115.1 AND sides = 'free' AND seed <= 20;

CREATE VIEW cube_means AS  -- means of cubes_20
SELECT spheres, filling, avg(walls_gpa) AS walls, avg(gauge_gpa) AS gauge, avg(uniform_strain_gpa) AS uniform,
  avg(contact_for_walls_gpa) AS contact_walls, avg(contact_for_gauge_gpa) AS contact_gauge
FROM cubes_20 GROUP BY spheres, filling;

CREATE VIEW fillings AS  -- means of the seeds; long, intermediate, short: cluster's dimension / shape's
SELECT shape, radius_min_mm AS low, radius_max_mm AS high, avg(spheres) AS spheres, avg(covered) AS covered,
  avg(outside) AS outside, avg(deviation_mean_mm) AS deviation, avg(d_long_mm / shape_d_long_mm) AS long,
  avg(d_intermediate_mm / shape_d_intermediate_mm) AS intermediate, avg(d_short_mm / shape_d_short_mm) AS short
FROM "fill-study.csv" GROUP BY shape, radius_min_mm, radius_max_mm;

CREATE VIEW dense_fillings AS  -- without voids, at 12.59 mm: means of the seeds
SELECT shape, radius_min_mm AS low, radius_max_mm AS high, avg(spheres) AS spheres,
  text('{:,.0f}, {:.0f} %', avg(spheres), 100 * avg(covered)) AS cell
FROM "fill-porosity-0.csv" WHERE d_intermediate_mm = 12.59 GROUP BY shape, radius_min_mm, radius_max_mm;

CREATE VIEW library_fillings AS  -- without voids, all shapes at 9 mm that become clusters
SELECT * FROM "fill-porosity-0.csv" WHERE d_intermediate_mm = 9 AND spheres > 1;

CREATE VIEW void_effects AS  -- means of the seeds; e (%) and phi: change from the same seeds without voids
SELECT r.radius_min_mm AS low, r.radius_max_mm AS high, r.fraction, r.frequency_hz, min(r.rowid) AS n,
  avg(r.voids) AS voids, avg(r.void_cells) AS cells, avg(r.e_star_pa) AS e_star, avg(r.phase_deg) AS phase,
  avg(100 * (r.e_star_pa / o.e_star_pa - 1)) AS e, avg(r.phase_deg - o.phase_deg) AS phi
FROM "voids.csv" r JOIN "voids.csv" o USING (radius_min_mm, radius_max_mm, frequency_hz, seed)
WHERE o.fraction = 0 GROUP BY 1, 2, 3, 4;

CREATE VIEW shape_correlations AS  -- Pearson's coefficients, ours and the paper's
SELECT first, second, coefficient AS paper, CASE second
  WHEN 'd_intermediate_m' THEN o.d_intermediate_m WHEN 'd_short_m' THEN o.d_short_m WHEN 'volume_m3' THEN o.volume_m3
  WHEN 'area_m2' THEN o.area_m2 WHEN 'shape_index' THEN o.shape_index WHEN 'flatness' THEN o.flatness
  WHEN 'flakiness' THEN o.flakiness WHEN 'elongation' THEN o.elongation WHEN 'sphericity_true' THEN o.sphericity_true
  WHEN 'sphericity_working' THEN o.sphericity_working END AS ours
FROM "bench/paper/paper-table-2.csv" JOIN "shapes-correlation.csv" o ON o.property = first;

-- Specimens and their results

CREATE VIEW study_means AS  -- |E*| (MPa) of a mix, and the variance of its seeds relative to it
SELECT m.*, (SELECT sum((e_star_mpa / m.e - 1) * (e_star_mpa / m.e - 1)) / (count(*) - 1) FROM "study.csv" s
  WHERE s.air_voids_percent = m.air_voids_percent AND s.binder_percent = m.binder_percent) AS variance
FROM (SELECT air_voids_percent, binder_percent, avg(e_star_mpa) AS e FROM "study.csv" GROUP BY 1, 2) m;

CREATE VIEW twin_differences AS  -- difference of twin and source: e (%), phi (degrees). Repacked twins have seed + 1000
SELECT s."case", s.seed, t.kind, t.frequency_hz, 100 * (t.e_star_pa / s.e_star_pa - 1) AS e,
  t.phase_deg - s.phase_deg AS phi
FROM "ct-twin.csv" s JOIN "ct-twin.csv" t ON t."case" = s."case" AND t.frequency_hz = s.frequency_hz
AND t.seed = s.seed + iif(t.kind = 'repacked', 1000, 0) WHERE s.kind = 'source' AND t.kind <> 'source';

CREATE VIEW twin_phases AS  -- phi of segmented twins at the lowest frequency: mean of the seeds and its standard error
SELECT "case", avg(phi) AS mean,
  sqrt((sum(phi * phi) - count(*) * avg(phi) * avg(phi)) / (count(*) - 1) / count(*)) AS error FROM twin_differences
WHERE kind = 'segmented' AND frequency_hz = (SELECT min(frequency_hz) FROM "ct-twin.csv") GROUP BY "case";

CREATE VIEW mastic_moduli AS  -- examples/mastic: the program's table, beside one contact of its law
SELECT m.*, c.modulus_gpa, c.phase_deg AS contact_phase FROM (
  SELECT cast(part(line, '^ +([\d.]+)') AS REAL) AS hz, cast(part(line, '^ +[\d.]+ +([\d.]+)') AS REAL) AS e,
    cast(part(line, '^ +[\d.]+ +[\d.]+ +([\d.]+)') AS REAL) AS phase,
    cast(part(line, '^(?: +\S+){3} +(\S+)') AS REAL) AS error_e,
    cast(part(line, '^(?: +\S+){4} +(\S+)') AS REAL) AS error_phase
  FROM "mastic-output.txt" WHERE matches(line, '^ +[\d.]+ +[\d.]+ +[\d.]+ +\S+ +\S+ +\S+ +\d+')) m
JOIN "mastic-contact.csv" c ON c.frequency_hz = m.hz;

CREATE VIEW printed_lines AS  -- the lines that runs printed about their specimens, with those of the size classes
SELECT 'demo' AS scene, line FROM "demo-output.txt" UNION ALL SELECT 'ac14_ss_am1', line FROM "paper-output.txt";

CREATE VIEW printed_sizes AS  -- the numbers of particles and contacts in printed_lines
SELECT p.scene, cast(part(line, '^(\d+) particles') AS REAL) AS particles,
  cast(part(line, '(\d+) contacts') AS REAL) AS contacts,
  cast(part(line, '(\d+) contact points') AS REAL) AS points, cast(part(line, 'M-M (\d+)') AS REAL) AS mm,
  cast(part(line, 'M-A (\d+)') AS REAL) AS ma, cast(part(line, 'A-A (\d+)') AS REAL) AS aa,
  cast(part(line, 'A-W (\d+)') AS REAL) AS aw, cast(part(line, 'M-W (\d+)') AS REAL) AS mw, aggregates
FROM printed_lines p JOIN (
  SELECT scene, sum(cast(part(line, '^[\d.]+-[\d.]+ mm +\d+ +(\d+)') AS REAL)) AS aggregates FROM printed_lines
  GROUP BY scene)
USING (scene) WHERE matches(line, '^\d+ particles');

CREATE VIEW paper_deviations AS  -- of clusters from single spheres, %: "+14 to +18 % (paper +19 %)"
SELECT quantity, part(specimen, '([^-]*)$') AS filling, text('{} % (paper {} %)', span(ours, text('{:+.0f}', ours)),
  span(paper, text('{:+.0f}', paper))) AS both
FROM "paper-summary.csv" WHERE quantity IN ('e_star', 'phase') GROUP BY 1, 2;

CREATE VIEW paper_met AS  -- the sentence on how well the reference publication is reproduced
SELECT text('Macadam reproduces the paper''s tables of shapes and compositions. Its stiffness figures are met in sign and order, but '
  || 'not in size: coarse clusters change \|E\*\| of single spheres by {}, fine clusters by {}, and φ of fine clusters by '
  || '{}. Clusters have {} % fewer contacts between aggregates, and the calibrated factor δ_MA of the coarse real shapes '
  || 'is {}.',
  (SELECT one(both) FROM paper_deviations WHERE quantity = 'e_star' AND filling = 'coarse'),
  (SELECT one(both) FROM paper_deviations WHERE quantity = 'e_star' AND filling = 'fine'),
  (SELECT one(both) FROM paper_deviations WHERE quantity = 'phase' AND filling = 'fine'),
  (SELECT span(ours, text('{:.0f}', ours)) FROM "paper-summary.csv" WHERE quantity = 'fewer contacts'),
  (SELECT text('{:.2f} ({:.2f})', one(ours), one(paper)) FROM "paper-summary.csv" WHERE quantity = 'delta_ma')) AS sentence;

-- Times

CREATE VIEW bench_cpu AS  -- macadam bench on a processor
SELECT rowid AS n, part(row, '([^/]+)/[^/]+/[^/]+/threads') AS form, part(row, '([^/]+)/[^/]+/threads') AS precision,
  part(row, '([^/]+)/threads') AS geometry, part(row, 'threads:(\d+)') AS threads, us / 1e3 AS ms,
  bytes_per_contact AS bytes, contacts / us AS contacts, memory_share AS share FROM "bench-cpu-2026-11-23.csv";

CREATE VIEW bench_cpu_pairs AS  -- contact points over condensed contacts, with the same settings
SELECT p.bytes / c.bytes AS bytes, p.ms / c.ms AS ms FROM bench_cpu c JOIN bench_cpu p
USING (precision, geometry, threads) WHERE c.form = 'condensed' AND p.form = 'points';

CREATE VIEW command_phases AS  -- bench/command/run, all machines
SELECT 'command-cpu.csv' AS file, rowid AS n, * FROM "command-cpu.csv" UNION ALL
SELECT 'command-gpu.csv', 1e6 + rowid, * FROM "command-gpu.csv";

CREATE VIEW command_machines AS  -- a row per file of command_phases
SELECT file, iif(device IS NULL, machine, text('{} and {}', device, machine)) AS machine, threads, date, "commit",
  listed(runs, runs) || iif(max(runs) = 1, ' run', ' runs') AS number,
  part(comment(file), '([^; ][^;]*)$') AS note, min(n)
FROM command_phases GROUP BY file;

CREATE VIEW gpu_scenes AS  -- names of scenes in tables
SELECT column1 AS k, column2 AS scene, column3 AS name FROM (VALUES
  (1, 'ac14_ss_am1', 'full specimen, 221,000 contacts'), (2, 'ac14_ms_ico_fine', 'MS-Ico-fine, 441,000 contacts'),
  (3, 'lattice:1e6', 'lattice of 10⁶, 5.9·10⁶ contacts'));

CREATE VIEW gpu_teams AS  -- microseconds on one GPU and on two
SELECT 'H100' AS gpu, a.row, a.us AS alone, b.us AS both, b.path FROM "team-h100-2026-11-24.csv" a
JOIN "team-h100-2026-11-24.csv" b ON b.row = a.row || '/devices:2' UNION ALL
SELECT 'H200', a.row, a.us, b.us, NULL FROM "team-harmonic-h200-2026-11-27.csv" a
JOIN "team-harmonic-h200-2026-11-27.csv" b ON b.row = a.row || '/devices:2';

CREATE VIEW more_gpus AS  -- rows on 1, 2, 3 and 4 GPUs of one machine; work: particles relative to the row on one GPU
SELECT gpu, row AS name, devices, us,
  CASE WHEN us < 1e3 THEN text('{:.1f} µs', us) WHEN us < 1e5 THEN text('{:.2f} ms', us / 1e3) WHEN us < 1e7
    THEN text('{:.2f} s', us / 1e6) ELSE text('{:.1f} s', us / 1e6) END AS time,
  CASE WHEN row LIKE '%1.6e7%' THEN 2 WHEN row LIKE '%3.2e7%' THEN 4 ELSE 1 END AS work
FROM "four-gpus-2026-11-27.csv";

CREATE VIEW many_means AS  -- mean seconds of many specimens on one GPU and on two, per version k of the program
SELECT "commit", row_number() OVER (ORDER BY min(rowid)) AS k, row_number() OVER (ORDER BY min(rowid) DESC) AS last,
  max(how LIKE 'tried: %') AS tried, avg(iif(devices = 1, seconds, NULL)) AS one_gpu,
  avg(iif(devices = 2, seconds, NULL)) AS two_gpus, max(gpu) AS gpu, max(date) AS date
FROM "many.csv" GROUP BY "commit";

-- Tests

CREATE VIEW mutations AS  -- deliberate mistakes in the code, per sample k
SELECT 1 AS k, file, verdict FROM "mutation.csv" UNION ALL SELECT 2, file, verdict FROM "mutation-second.csv" UNION ALL
SELECT 3, file, verdict FROM "mutation-third.csv" UNION ALL SELECT 4, file, verdict FROM "mutation-fourth.csv" UNION ALL
SELECT 5, file, verdict FROM "mutation-fifth.csv" UNION ALL SELECT 6, file, verdict FROM "mutation-sixth.csv" UNION ALL
SELECT 7, file, verdict FROM "mutation-seventh.csv";

CREATE VIEW mutation_survivors AS  -- mistakes that no test noticed, as they were judged
SELECT 1 AS k, looked_at FROM "mutation-survivors.csv" UNION ALL
SELECT 2, looked_at FROM "mutation-second-survivors.csv" UNION ALL
SELECT 3, looked_at FROM "mutation-third-survivors.csv" UNION ALL
SELECT 4, looked_at FROM "mutation-fourth-survivors.csv" UNION ALL
SELECT 5, looked_at FROM "mutation-fifth-survivors.csv" UNION ALL
SELECT 6, looked_at FROM "mutation-sixth-survivors.csv" UNION ALL
SELECT 7, looked_at FROM "mutation-seventh-survivors.csv";

CREATE VIEW mutation_rates AS  -- per sample: noticed; changed: those that change a result; since: with later tests
SELECT k, count(*) AS drawn, 1.0 * sum(verdict = 'killed') / sum(verdict IN ('killed', 'survived')) AS noticed,
  sum(verdict = 'killed') AS killed, count(*) - s.same AS changed,
  1.0 * sum(verdict = 'killed') / (count(*) - s.same) AS at_once,
  1.0 * (sum(verdict = 'killed') + s.since) / (count(*) - s.same) AS since,
  count(*) - sum(verdict = 'killed') - s.judged AS not_judged
FROM mutations JOIN (SELECT k, sum(looked_at = 'same') AS same, sum(looked_at = 'tested since') AS since,
                       count(looked_at) AS judged FROM mutation_survivors GROUP BY k) s USING (k) GROUP BY k;

-- Errors of the model

CREATE VIEW model_errors AS  -- contact networks beside the continuum: e (%), phi (degrees), u: uncertainty of the continuum (%)
SELECT *, error_percent AS e, phase_error_deg AS phi, 100 * continuum_uncertainty / continuum_over_mastic AS u,
  iif(mastic_radius_m = '0.00075 0.001', 'published', 'halved') AS spheres,
  NOT (rule = 'series' AND coalesce(void_rule, '') = 'spheres') AS usual,  -- made with the default of the key void_cells
  CASE text('{:.1f}', ratio) WHEN '14.3' THEN 'AM1, 2 Hz' WHEN '10.4' THEN 'AM1, 20 Hz' WHEN '36.8' THEN 'AM2, 2 Hz' ELSE '' END AS mastic,
  CASE WHEN geometry LIKE 'packed%' THEN 'packed' WHEN geometry LIKE 'shapes%' THEN 'shapes' WHEN void_nominal > 0 THEN 'voids' ELSE 'balls' END AS kind,
  text(CASE WHEN geometry LIKE 'packed%' THEN 'packed shapes, {:.0f} %' WHEN geometry LIKE 'shapes%' THEN 'shapes, {:.0f} %' WHEN void_nominal > 0 THEN 'balls, {:.0f} %, voids {:.0f} %'
       ELSE 'balls, {:.0f} %' END, 100 * rock_nominal, 100 * void_nominal) AS specimen
FROM "model-error.csv";

CREATE VIEW model_table AS  -- the errors of both rules in one row per geometry, size of spheres and ratio
SELECT specimen, kind, rock_nominal, void_nominal, spheres, ratio, mastic, min(continuum_voxels_m) AS voxels, avg(continuum_over_mastic) AS continuum, avg(u) AS u,
  avg(continuum_phase_deg) AS phase,
  max(iif(rule = 'series' AND filling = 'single', e, NULL)) AS s1, max(iif(rule = 'series' AND filling = 'coarse', e, NULL)) AS s2,
  max(iif(rule = 'series' AND filling = 'fine', e, NULL)) AS s3,
  max(iif(rule = 'centres' AND filling = 'single', e, NULL)) AS c1, max(iif(rule = 'centres' AND filling = 'coarse', e, NULL)) AS c2,
  max(iif(rule = 'centres' AND filling = 'fine', e, NULL)) AS c3,
  max(iif(rule = 'series' AND filling = 'single', phi, NULL)) AS f1, max(iif(rule = 'series' AND filling = 'coarse', phi, NULL)) AS f2,
  max(iif(rule = 'series' AND filling = 'fine', phi, NULL)) AS f3
FROM model_errors WHERE usual GROUP BY geometry, seed, spheres, ratio;

CREATE VIEW model_certain AS  -- networks whose continuum is known to 4 %, from three voxel sizes
SELECT * FROM model_errors WHERE usual AND spheres = 'published' AND u < 4 AND continuum_voxels_m LIKE '% % %';

CREATE VIEW model_unsure AS  -- the other networks
SELECT * FROM model_errors WHERE usual AND spheres = 'published' AND NOT (u < 4 AND continuum_voxels_m LIKE '% % %');

CREATE VIEW model_spreads AS  -- largest difference between the divisions of one geometry into spheres (%)
SELECT geometry, rule, ratio, mastic, 100 * (max(e_star_over_mastic) / min(e_star_over_mastic) - 1) AS spread,
  max(phase_deg) - min(phase_deg) AS phase_spread, count(*) AS n
FROM model_errors WHERE usual AND spheres = 'published' GROUP BY geometry, seed, rule, ratio;

CREATE VIEW series_paper AS  -- specimens of the study with rule series: difference of |E*| (%) and phi from single spheres
SELECT s.*, 100 * (s.e_star_pa / r.e_star_pa - 1) AS e, 100 * (s.phase_deg / r.phase_deg - 1) AS phi,
  CASE s.scene WHEN 'ac14_ss_am1' THEN 'SS' WHEN 'ac14_ms_poly_coarse' THEN 'MS-Poly-coarse' WHEN 'ac14_ms_poly_fine' THEN 'MS-Poly-fine'
    WHEN 'ac14_ms_ico_coarse' THEN 'MS-Ico-coarse' ELSE 'MS-Ico-fine' END AS specimen
FROM "series-paper.csv" s JOIN "series-paper.csv" r USING (seed, mix, reading, frequency_hz) WHERE r.scene = 'ac14_ss_am1';

CREATE VIEW model_bounds AS  -- networks and the bounds of Hashin and Shtrikman; above, below: distance (%) above the lower and below the upper bound
SELECT *, 100 * (e_over_mastic / lower - 1) AS above, 100 * (1 - e_over_mastic / upper) AS below,
  100 * (e_over_mastic / lower_zero - 1) AS above_zero, 100 * (1 - e_over_mastic / upper_zero) AS below_zero
FROM "bounds.csv";

-- Mixtures

CREATE VIEW mixture_convergence AS  -- a case of bench/mixture/convergence at one point of the test: geometric mean over the seeds
SELECT study, radius_m, box_over_grain, temperature_c, frequency_hz, count(*) AS seeds, max(particles) AS particles,
  exp(avg(ln(e_star_pa))) AS e, avg(phase_deg) AS phase,
  100 * sqrt(max(0, avg(ln(e_star_pa) * ln(e_star_pa)) - avg(ln(e_star_pa)) * avg(ln(e_star_pa))) * count(*) / (count(*) - 1)) AS scatter
FROM "mixture-convergence.csv" GROUP BY study, radius_m, box_over_grain, temperature_c, frequency_hz;

CREATE VIEW mixture_finer AS  -- change (%) of |E*| and of phi by smaller spheres, over the seeds that both have
SELECT a.radius_m AS coarse, b.radius_m AS fine, a.temperature_c, a.frequency_hz,
  100 * (exp(avg(ln(b.e_star_pa / a.e_star_pa))) - 1) AS e, avg(b.phase_deg - a.phase_deg) AS phi
FROM "mixture-convergence.csv" a JOIN "mixture-convergence.csv" b USING (study, seed, temperature_c, frequency_hz)
WHERE study = 'radius' AND b.radius_m < a.radius_m GROUP BY a.radius_m, b.radius_m, a.temperature_c, a.frequency_hz;

-- |E*| [%], phi [degrees] and Poisson's ratio of discs in indirect tension minus those of boxes in the uniaxial test, and
-- the range of |E*| over the seeds of the discs and of the boxes [%].
CREATE VIEW disc_against_box AS
SELECT material, strips, frequency_hz, 100 * (avg(d.e_star_pa) / u.e - 1) AS e, avg(d.phase_deg) - u.phi AS phi,
  avg(d.poisson_ratio) - u.nu AS nu, 100 * (max(d.e_star_pa) - min(d.e_star_pa)) / avg(d.e_star_pa) AS range_of_discs,
  u.range AS range_of_boxes
FROM "laboratory-tests.csv" d JOIN (
  SELECT material, frequency_hz, avg(e_star_pa) AS e, avg(phase_deg) AS phi, avg(poisson_ratio) AS nu,
    100 * (max(e_star_pa) - min(e_star_pa)) / avg(e_star_pa) AS range
  FROM "laboratory-tests.csv" WHERE test = 'uniaxial' GROUP BY material, frequency_hz) u USING (material, frequency_hz)
WHERE d.test = 'indirect_tension' GROUP BY material, strips, frequency_hz;

-- |E*| [%] and phi [degrees] of beams in bending minus those of boxes in the uniaxial test.
CREATE VIEW beam_against_box AS
SELECT material, d.test AS test, frequency_hz, 100 * (avg(d.e_star_pa) / u.e - 1) AS e, avg(d.phase_deg) - u.phi AS phi,
  100 * (max(d.e_star_pa) - min(d.e_star_pa)) / avg(d.e_star_pa) AS range_of_beams
FROM "laboratory-tests.csv" d JOIN (
  SELECT material, frequency_hz, avg(e_star_pa) AS e, avg(phase_deg) AS phi
  FROM "laboratory-tests.csv" WHERE test = 'uniaxial' GROUP BY material, frequency_hz) u USING (material, frequency_hz)
WHERE d.test LIKE 'bending%' GROUP BY material, d.test, frequency_hz;

-- Cracks beside fracture mechanics (bench/fracture/run)

CREATE VIEW fracture_origins AS  -- commits and machines of all tables
SELECT "commit", machine FROM "fracture-strip.csv" UNION SELECT "commit", machine FROM "fracture-griffith.csv"
UNION SELECT "commit", machine FROM "fracture-size.csv" UNION SELECT "commit", machine FROM "fracture-disc.csv"
UNION SELECT "commit", machine FROM "fracture-half-disc.csv";

-- Measured peaks of the IDEAL-CT of a lane [kN, mm], and the computed load at that displacement by set of parameters.
CREATE VIEW validation_lanes AS
SELECT m.*, parameters, max(k) AS discs, avg(load) AS load, min(load) AS load_min, max(load) AS load_max, rise, strength, energy, thickness
FROM (SELECT lane, count(*) AS n, avg(peak_load_n) / 1e3 AS peak, avg(displacement_at_peak_m) * 1e3 AS at,
    sqrt((avg(peak_load_n * peak_load_n) - avg(peak_load_n) * avg(peak_load_n)) * count(*) / (count(*) - 1)) / 1e3 AS peak_sd,
    sqrt((avg(displacement_at_peak_m * displacement_at_peak_m) - avg(displacement_at_peak_m) * avg(displacement_at_peak_m)) * count(*) / (count(*) - 1)) * 1e3 AS at_sd
  FROM "validation-measured.csv" GROUP BY lane) m
JOIN (SELECT c.lane AS lane, c.parameters AS parameters, c.seed AS k, c.load_n / 1e3 AS load, min(abs(c.displacement_m - w.at)) AS nearest,
    v.peak_load_n > 1.001 * c.load_n AS rise, v.tensile_strength_pa AS strength, v.fracture_energy_j_m2 AS energy, v.thickness_m AS thickness
  FROM "validation-curves.csv" c JOIN (SELECT lane, avg(displacement_at_peak_m) AS at FROM "validation-measured.csv" GROUP BY lane) w ON w.lane = c.lane
  JOIN "validation.csv" v ON v.lane = c.lane AND v.parameters = c.parameters AND v.seed = c.seed
  GROUP BY c.lane, c.parameters, c.seed) USING (lane)
GROUP BY lane, parameters;

-- |G*| of cylinders in torsion minus E*/(2·(1 + ν)) of boxes in the uniaxial test [%], and phi [degrees].
CREATE VIEW torsion_against_box AS
SELECT material, frequency_hz, avg(d.g_star_pa) AS g, u.e / (2 * (1 + u.nu)) AS expected, 100 * (avg(d.g_star_pa) * 2 * (1 + u.nu) / u.e - 1) AS difference, avg(d.phase_deg) - u.phi AS phi
FROM "laboratory-tests.csv" d JOIN (
  SELECT material, frequency_hz, avg(e_star_pa) AS e, avg(phase_deg) AS phi, avg(poisson_ratio) AS nu
  FROM "laboratory-tests.csv" WHERE test = 'uniaxial' GROUP BY material, frequency_hz) u USING (material, frequency_hz)
WHERE d.test = 'torsion' GROUP BY material, frequency_hz;

-- |E*| of one material in every test, beside the uniaxial test: difference [%] of the modulus and [degrees] of phi, and the
-- range over the seeds [%]. In torsion |E*| is 2·(1 + ν)·|G*| with the uniaxial ν. Strips and rollers are smooth.
CREATE VIEW five_tests AS
SELECT material, frequency_hz, test, avg(m) AS modulus, 100 * (avg(m) / e - 1) AS difference, avg(phi) - phi0 AS phase, 100 * (max(m) - min(m)) / avg(m) AS range,
  avg(poisson_ratio) AS poisson
FROM (SELECT d.material AS material, d.frequency_hz AS frequency_hz, d.test AS test, iif(d.test = 'torsion', d.g_star_pa * 2 * (1 + u.nu), d.e_star_pa) AS m, d.phase_deg AS phi,
    u.e AS e, u.phi AS phi0, d.poisson_ratio AS poisson_ratio
  FROM "laboratory-tests.csv" d JOIN (
    SELECT material, frequency_hz, avg(e_star_pa) AS e, avg(phase_deg) AS phi, avg(poisson_ratio) AS nu
    FROM "laboratory-tests.csv" WHERE test = 'uniaxial' GROUP BY material, frequency_hz) u USING (material, frequency_hz)
  WHERE d.strips <> 'glued' OR d.test = 'torsion' OR d.strips IS NULL)
GROUP BY material, frequency_hz, test;
