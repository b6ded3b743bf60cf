#!/usr/bin/env python3
"""reference_cases_test.py GENIO SOURCE: small recordings that were once read wrongly, a line each.

The recordings stand beside the project in ../shared/reference/cases and are read in place; where
they are absent the test is skipped (77).
"""
import json
import pathlib
import re
import subprocess
import sys

genio, source = sys.argv[1], pathlib.Path(sys.argv[2])
cases = source.parent / 'shared/reference/cases'
if not cases.is_dir():
    print(f'skipped: {cases} is not here')
    sys.exit(77)



def close(scale, rms):
    return lambda a: abs(a['registration']['scale'] - scale) < 0.06 and a['rms_mm'] < rms


def forces(**newtons):
    return lambda a: all(abs(a['forces_N'][k] - v) < 0.6 for k, v in newtons.items())


def sides_alike_or_told(a):
    best = a['forces_N']
    return a['mirrored'] is not None or all(
        abs(f - best[k[:-1] + 'R']) < 0.1 for k, f in best.items() if k.endswith('_L'))


# What must hold: the exit status, a text among all that is printed (None: any), and what of the
# first answer.
EXPECTED = {
    'aaa_dlc_wide_knots': (0, 'span 80 mm', None),
    'aaa_polar_confidence': (0, 'confidence', close(0.98, 0.3)),
    'aaa_roof_first': (0, None, forces(GGP=2.7, HG=1.1, TRANS=0.5)),
    'aaa_tab_in_prompt': (2, 'target.tsv:2: 90 fields', None),
    'aaa_xy_block_header': (0, None, close(0.98, 0.3)),
    'ag501_pos_cut_short': (0, 'no whole sample', None),
    'ag501_write_table': (0, None, None),
    'csv_frame_twice': (2, 'Two takes?', None),
    'edgetrak_concave': (0, 'y down', None),
    'edgetrak_zero_padded': (0, None, close(0.98, 0.3)),
    'ema_98_columns': (0, None, close(0.99, 0.15)),
    'ema_decimal_comma': (0, None, None),
    'ema_sensor_places': (1, 'apart', None),
    'ema_sweep_x_backwards': (0, None, close(0.99, 0.15)),
    'ema_vertical_y': (0, None, close(0.99, 0.15)),
    'fmt_deeplabcut': (0, 'likelihood', None),
    'fmt_deeplabcut_stripped': (2, 'without their three header rows', None),
    'fmt_mocha_ascii': (2, 'tt: about', None),
    'fmt_mtracker': (0, None, close(0.98, 0.3)),
    'fmt_ndi_wave': (2, 'at least 5 points', None),
    # Read, but no tongue at its pixels' size: the message tells at which it would be one.
    'fmt_usc_pts': (2, '270 px are 80 mm at --mm-per-px 0.3', None),
    'fmt_xrmb': (0, None, None),
    'no_palate': (2, '--facing left', None),
    'registration_upside_down': (1, 'cannot be laid beside the model', None),
    'symmetric_scan': (0, None, sides_alike_or_told),
    'ssff_one_sensor_a_file': (0, None, close(0.99, 0.3)),
    'time_and_label_lost': (0, None, lambda a: a['time_s'] is not None and a['label']),
}
# Options that a case's command leaves out.
OPTIONS = {
    'ag501_pos_cut_short': ['--sensors', '1=tip,2=blade', '--force-registration'],
}


def command_of(folder):
    text = (folder / 'EXPECT.txt').read_text()
    words = re.search(r'^command: genio (.*)$', text, re.M).group(1).split()
    if '...' in words:  # "--palate ..." where there is none
        at = words.index('...')
        del words[at - 1:at + 1]
    words = [w.replace(',...', '').rstrip(';') for w in words]
    if '--out' in words:
        at = words.index('--out')
        del words[at:at + 2]
    return words + OPTIONS.get(folder.name, [])


def fault(name):
    status, said, holds = EXPECTED[name]
    done = subprocess.run([genio, *command_of(cases / name), '--json'], cwd=cases / name,
                          capture_output=True, text=True, timeout=300)
    printed = done.stdout + done.stderr
    if done.returncode != status:
        return f'exit status {done.returncode}, expected {status}: {printed[-300:]}'
    if said and said not in printed:
        return f"does not say '{said}': {printed[-300:]}"
    if holds and not holds(json.loads(done.stdout.splitlines()[0])):
        return f'answers otherwise: {done.stdout[:600]}'
    return None


failed = 0
for folder in sorted(cases.iterdir()):
    if (folder / 'EXPECT.txt').is_file() and folder.name not in EXPECTED:
        print(f'{folder.name:<28} FAILED: nothing is expected of it here')
        failed += 1
for name in sorted(EXPECTED):
    if not (cases / name).is_dir():
        continue
    wrong = fault(name)
    failed += wrong is not None
    print(f"{name:<28} {'ok' if wrong is None else 'FAILED: ' + wrong}", flush=True)
sys.exit(1 if failed else 0)
