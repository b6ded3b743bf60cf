cmake -S . -B build/lint-files -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null
cmake --build build/lint-files --target genio_messages_generated >/dev/null
for f in runs/corpus/manifest.cpp runs/corpus/task.cpp runs/corpus/planning.cpp runs/corpus/corpus_results.cpp runs/corpus/slurm.cpp runs/corpus/plan.cpp runs/corpus/kept_recording.cpp runs/process/workers.cpp runs/process/program.cpp report/corpus_report.cpp runs/frames/frame_by_frame.cpp runs/frames/inversion.cpp bench/figures/corpus.cpp bench/experiments/recordings/synthetic_corpus.cpp cli/subcommands/corpus.cpp cli/subcommands/invert.cpp cli/command_line/command_line.cpp; do
 echo "== $f"; nice -n 5 clang-tidy -p build/lint-files --quiet --extra-arg=-Wno-unknown-warning-option /work/main/$f 2>/dev/null
done
