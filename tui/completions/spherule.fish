# Print an optspec for argparse to handle cmd's options that are independent of any subcommand.
function __fish_spherule_global_optspecs
    string join \n size= samples= projection= eye= target= fov= orbit= order= format= columns= strict topology= follow frame= frames= radius= accuracy= charset= color= background= palette= cell-aspect= distance= show= color-by= range= legend occlusion edges depth-cue structure= threads= level= no-probe lossless fps= output= once cast= png= pick= json h/help V/version
end

function __fish_spherule_needs_command
    # Figure out if the current invocation already has a command.
    set -l cmd (commandline -opc)
    set -e cmd[1]
    argparse -s (__fish_spherule_global_optspecs) -- $cmd 2>/dev/null
    or return
    if set -q argv[1]
        # Also print the command, so this can be used to figure out what it is.
        echo $argv[1]
        return 1
    end
    return 0
end

function __fish_spherule_using_subcommand
    set -l cmd (__fish_spherule_needs_command)
    test -z "$cmd"
    and return 1
    contains -- $cmd[1] $argv
end

complete -c spherule -n "__fish_spherule_needs_command" -l size -d 'Size of a picture in cells, each 1 to 4096; the viewer does not open [default: 80x24; on a terminal all rows but the last]' -r
complete -c spherule -n "__fish_spherule_needs_command" -l samples -d 'Rays a cell, 1 to 256; auto: more where they are needed' -r
complete -c spherule -n "__fish_spherule_needs_command" -l projection -d 'The projection, whatever the scene says' -r -f -a "perspective\t'Far things look smaller'
parallel\t'They do not'"
complete -c spherule -n "__fish_spherule_needs_command" -l eye -d 'Where the eye is, whatever the scene says' -r
complete -c spherule -n "__fish_spherule_needs_command" -l target -d 'The point looked at, whatever the scene says' -r
complete -c spherule -n "__fish_spherule_needs_command" -l fov -d 'The vertical field of view in degrees; in parallel projection, the angle at which the eye sees the height at the target' -r
complete -c spherule -n "__fish_spherule_needs_command" -l orbit -d 'Turn the eye around the target, after --eye and --target: degrees right, degrees up' -r
complete -c spherule -n "__fish_spherule_needs_command" -l order -d 'Which loop is the outer one, over rays or spheres; object excludes --structure' -r -f -a "image\t'For each ray the spheres, by a structure'
object\t'For each sphere the rays that may meet it'"
complete -c spherule -n "__fish_spherule_needs_command" -l format -d 'Format of the scene [default: by content; .gz and .bz2 are unpacked]' -r -f -a "toml\t'Spheres, lights and a camera: Spherule\'s own'
xyz\t'XYZ and extended XYZ'
pdb\t'Protein Data Bank'
mmcif\t'Macromolecular Crystallographic Information File'
gro\t'GROMACS\'s .gro'
lammps-dump\t'A trajectory of LAMMPS'
lammps-data\t'The input of LAMMPS'
mercury\t'MercuryDPM\'s .data'
csv\t'A table: comma, tab, semicolon or space between columns'
ply\t'Stanford\'s polygons: their points'
npy\t'numpy\'s array, (N, 3) or (N, 4)'
xtc\t'GROMACS\'s compressed trajectory'
urdf\t'A robot whose parts are spheres'"
complete -c spherule -n "__fish_spherule_needs_command" -l columns -d 'Columns of a table for x, y, z and perhaps the radius: names, or numbers from 1' -r
complete -c spherule -n "__fish_spherule_needs_command" -l topology -d 'The file that says what the particles of an .xtc are' -r
complete -c spherule -n "__fish_spherule_needs_command" -l frame -d 'The frame that is shown first, from 0 [default: the first with particles]' -r
complete -c spherule -n "__fish_spherule_needs_command" -l frames -d 'Write the pictures of frames A to B - 1, from 0; without B, up to the last; N is 0..N' -r
complete -c spherule -n "__fish_spherule_needs_command" -l radius -d 'How large spheres are: van-der-waals, covalent, a number, or a column of numbers [default: as the scene says]' -r
complete -c spherule -n "__fish_spherule_needs_command" -l accuracy -d 'How far hits may be trusted; algebraic is another name for fast' -r -f -a "fast\t''
geometric\t''
stable\t''
exact\t''"
complete -c spherule -n "__fish_spherule_needs_command" -l charset -d 'Characters' -r -f -a "auto\t'Half with colour, ascii without colour or Unicode'
ascii\t'Printable ASCII; in every font'
half\t'Halves of a cell; in every font'
quadrant\t'Quarters; in most fonts'
sextant\t'Sixths; in fonts with Unicode 13'
octant\t'Eighths of two columns; in fonts with Unicode 16'
braille\t'Dots, as plots have them; in most fonts'
block\t'All of these that are blocks, and bars; in fonts with Unicode 16'"
complete -c spherule -n "__fish_spherule_needs_command" -l color -d 'Colours' -r -f -a "auto\t'As the environment and the terminal say'
never\t'No colour'
always\t'As many colours as the terminal has, also into a pipe'
16\t'The 16 of the user\'s theme'
256\t'The xterm palette'
truecolor\t'24 bits'"
complete -c spherule -n "__fish_spherule_needs_command" -l background -d 'The colour of what no sphere covers, unless the scene names one' -r
complete -c spherule -n "__fish_spherule_needs_command" -l palette -d 'What the terminal\'s 16 colours are: xterm, vga, tango, solarized, or 16 of six digits, with commas [default: xterm, on Linux\'s console vga]' -r
complete -c spherule -n "__fish_spherule_needs_command" -l cell-aspect -d 'Shape of a cell, width to height [default: the terminal\'s, else 1:2]' -r
complete -c spherule -n "__fish_spherule_needs_command" -l distance -d 'How far away the eye is, in widths of a cell: 60 cm by default, if cells are 2.2 mm wide' -r
complete -c spherule -n "__fish_spherule_needs_command" -l show -d 'error: what the tier gets wrong against exact, cell by cell; split:TIER,TIER: two tiers side by side; table: what every tier costs and gets wrong' -r
complete -c spherule -n "__fish_spherule_needs_command" -l color-by -d 'What spheres are coloured by: scene, element, chain, residue, molecule, type, or a column of numbers [default: chain if there are several, else scene]' -r
complete -c spherule -n "__fish_spherule_needs_command" -l range -d 'The numbers that get the darkest and the lightest colour; needs --color-by COLUMN [default: the least and the largest of the frames so far]' -r
complete -c spherule -n "__fish_spherule_needs_command" -l structure -d 'How spheres are searched' -r -f -a "auto\t'The one that is likely the fastest'
brute\t'All spheres, from end to end'
depth-list\t'The spheres by their depth, for rays that share an origin or a direction; other rays search all'
bvh\t'A tree of boxes, built once'"
complete -c spherule -n "__fish_spherule_needs_command" -l threads -d 'Threads, 1 to 1024 [default: one a core, or as many as the system gives]' -r
complete -c spherule -n "__fish_spherule_needs_command" -l level -d 'Instructions [default: the best that the CPU has]' -r -f -a "baseline\t''
avx2\t''
avx512\t''"
complete -c spherule -n "__fish_spherule_needs_command" -l fps -d 'Frames a second of the viewer at most, 1 to 240 [default: 60, over SSH 30]' -r
complete -c spherule -n "__fish_spherule_needs_command" -l output -d 'What is written: cells, or pixels by a protocol of terminals' -r -f -a "auto\t'Pixels if the terminal says that it has them, else cells'
cells\t'Characters'
kitty\t'Pixels by kitty\'s protocol; under tmux by placeholders, with allow-passthrough on'
sixel\t'Pixels in 256 colours'
iterm2\t'Pixels by iTerm2\'s protocol'"
complete -c spherule -n "__fish_spherule_needs_command" -l cast -d 'Write one turn around the scene as a recording of a terminal (asciinema, version 2); - for standard output' -r -F
complete -c spherule -n "__fish_spherule_needs_command" -l png -d 'Write one picture as a PNG of 8x16 pixels a cell; - for standard output' -r -F
complete -c spherule -n "__fish_spherule_needs_command" -l pick -d 'Instead of a picture, write what the ray through the middle of a cell meets, by every tier' -r
complete -c spherule -n "__fish_spherule_needs_command" -l strict -d 'Refuse particles of unknown types, which are drawn grey otherwise'
complete -c spherule -n "__fish_spherule_needs_command" -l follow -d 'Wait for frames that are still being written'
complete -c spherule -n "__fish_spherule_needs_command" -l legend -d 'Write what colours mean over the picture, also outside the viewer'
complete -c spherule -n "__fish_spherule_needs_command" -l occlusion -d 'Darken spheres where others block light; auto: if there are chains'
complete -c spherule -n "__fish_spherule_needs_command" -l edges -d 'Darken edges before far things, and around chains; auto: if there are chains'
complete -c spherule -n "__fish_spherule_needs_command" -l depth-cue -d 'Fade what is far away; auto: if there are chains'
complete -c spherule -n "__fish_spherule_needs_command" -l no-probe -d 'Ask the terminal nothing: not what it can do, nor how far it has come'
complete -c spherule -n "__fish_spherule_needs_command" -l lossless -d 'Send the viewer\'s frames exactly, none that merely looks alike'
complete -c spherule -n "__fish_spherule_needs_command" -l once -d 'Write one picture, also to a terminal; so does --size'
complete -c spherule -n "__fish_spherule_needs_command" -l json -d 'With --pick, write a JSON object'
complete -c spherule -n "__fish_spherule_needs_command" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c spherule -n "__fish_spherule_needs_command" -s V -l version -d 'Print version'
complete -c spherule -n "__fish_spherule_needs_command" -a "trace" -d 'Trace rays from a file against spheres from a file'
complete -c spherule -n "__fish_spherule_needs_command" -a "tradeoff" -d 'Measure speed and error of every tier on a scene, on this machine'
complete -c spherule -n "__fish_spherule_needs_command" -a "lecture" -d 'Walk through the graphics lecture: fourteen stations whose numbers are computed as they are shown'
complete -c spherule -n "__fish_spherule_needs_command" -a "cases" -d 'Write cases in which ray-sphere intersection goes wrong, or list their families'
complete -c spherule -n "__fish_spherule_needs_command" -a "judge" -d 'Judge another program\'s answers against exact truth'
complete -c spherule -n "__fish_spherule_needs_command" -a "scenes" -d 'List the built-in scenes'
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l spheres -d 'Spheres: .npy, float32 or float64, (N, 4): centre xyz, radius' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l rays -d 'Rays: .npy, float32 or float64, (M, 8): origin xyz, direction xyz, t_min, t_max' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l out-t -d 'Where to write t: .npy, float32, (M,), +inf if a ray has no hit' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l out-id -d 'Where to write the sphere: .npy, int32, (M,), -1 if a ray has no hit; with --any 1 or 0' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l repeat -d 'Passes, 1 to 1000000; the speed is that of their median' -r
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l accuracy -d 'How far hits may be trusted; algebraic is another name for fast' -r -f -a "fast\t''
geometric\t''
stable\t''
exact\t''"
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l structure -d 'How spheres are searched' -r -f -a "auto\t'The one that is likely the fastest'
brute\t'All spheres, from end to end'
depth-list\t'The spheres by their depth, for rays that share an origin or a direction; other rays search all'
bvh\t'A tree of boxes, built once'"
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l threads -d 'Threads, 1 to 1024 [default: one a core, or as many as the system gives]' -r
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l level -d 'Instructions [default: the best that the CPU has]' -r -f -a "baseline\t''
avx2\t''
avx512\t''"
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l pairs -d 'Test ray i against sphere i'
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l any -d 'Write only whether rays hit anything'
complete -c spherule -n "__fish_spherule_using_subcommand trace" -l json -d 'Report as a JSON object'
complete -c spherule -n "__fish_spherule_using_subcommand trace" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l samples -d 'Rays a cell, 1 to 256; auto: more where they are needed' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l projection -d 'The projection, whatever the scene says' -r -f -a "perspective\t'Far things look smaller'
parallel\t'They do not'"
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l eye -d 'Where the eye is, whatever the scene says' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l target -d 'The point looked at, whatever the scene says' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l fov -d 'The vertical field of view in degrees; in parallel projection, the angle at which the eye sees the height at the target' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l orbit -d 'Turn the eye around the target, after --eye and --target: degrees right, degrees up' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l order -d 'Which loop is the outer one, over rays or spheres; object excludes --structure' -r -f -a "image\t'For each ray the spheres, by a structure'
object\t'For each sphere the rays that may meet it'"
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l format -d 'Format of the scene [default: by content; .gz and .bz2 are unpacked]' -r -f -a "toml\t'Spheres, lights and a camera: Spherule\'s own'
xyz\t'XYZ and extended XYZ'
pdb\t'Protein Data Bank'
mmcif\t'Macromolecular Crystallographic Information File'
gro\t'GROMACS\'s .gro'
lammps-dump\t'A trajectory of LAMMPS'
lammps-data\t'The input of LAMMPS'
mercury\t'MercuryDPM\'s .data'
csv\t'A table: comma, tab, semicolon or space between columns'
ply\t'Stanford\'s polygons: their points'
npy\t'numpy\'s array, (N, 3) or (N, 4)'
xtc\t'GROMACS\'s compressed trajectory'
urdf\t'A robot whose parts are spheres'"
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l columns -d 'Columns of a table for x, y, z and perhaps the radius: names, or numbers from 1' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l topology -d 'The file that says what the particles of an .xtc are' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l radius -d 'How large spheres are: van-der-waals, covalent, a number, or a column of numbers [default: as the scene says]' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l structure -d 'How spheres are searched' -r -f -a "auto\t'The one that is likely the fastest'
brute\t'All spheres, from end to end'
depth-list\t'The spheres by their depth, for rays that share an origin or a direction; other rays search all'
bvh\t'A tree of boxes, built once'"
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l threads -d 'Threads, 1 to 1024 [default: one a core, or as many as the system gives]' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l level -d 'Instructions [default: the best that the CPU has]' -r -f -a "baseline\t''
avx2\t''
avx512\t''"
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l frames -d 'Write the pictures of frames A to B - 1, from 0; without B, up to the last; N is 0..N' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l frame -d 'The frame that is measured, from 0 [default: the first with particles]' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l size -d 'Size of the picture in cells, each 1 to 4096 [default: 80x24]' -r
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l strict -d 'Refuse particles of unknown types, which are drawn grey otherwise'
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l follow -d 'Wait for frames that are still being written'
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -l json -d 'Report as a JSON object'
complete -c spherule -n "__fish_spherule_using_subcommand tradeoff" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c spherule -n "__fish_spherule_using_subcommand lecture" -l station -d 'The station, 1 to 14 or by its name' -r
complete -c spherule -n "__fish_spherule_using_subcommand lecture" -l size -d 'Size of a station in cells [default: 80x24; on a terminal all rows but the last]' -r
complete -c spherule -n "__fish_spherule_using_subcommand lecture" -l color -d 'Colours' -r -f -a "auto\t'As the environment and the terminal say'
never\t'No colour'
always\t'As many colours as the terminal has, also into a pipe'
16\t'The 16 of the user\'s theme'
256\t'The xterm palette'
truecolor\t'24 bits'"
complete -c spherule -n "__fish_spherule_using_subcommand lecture" -l once -d 'Write the station, or all, also to a terminal; so does --size'
complete -c spherule -n "__fish_spherule_using_subcommand lecture" -l list -d 'List the stations, with the part of the lecture and the source files of each'
complete -c spherule -n "__fish_spherule_using_subcommand lecture" -l no-probe -d 'Ask the terminal nothing'
complete -c spherule -n "__fish_spherule_using_subcommand lecture" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c spherule -n "__fish_spherule_using_subcommand cases" -l family -d 'Families, with commas between them [default: all]' -r
complete -c spherule -n "__fish_spherule_using_subcommand cases" -l count -d 'How many cases, of all families together and in turns' -r
complete -c spherule -n "__fish_spherule_using_subcommand cases" -l seed -d 'Their seed' -r
complete -c spherule -n "__fish_spherule_using_subcommand cases" -l out-spheres -d 'Where to write spheres: .npy, float32, (N, 4): centre xyz, radius' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand cases" -l out-rays -d 'Where to write rays: .npy, float32, (N, 8): origin xyz, direction xyz, t_min, t_max' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand cases" -l out-family -d 'Where to write the numbers of families: .npy, uint8, (N,)' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand cases" -l unit -d 'Bring directions to unit length, as near as float32 does'
complete -c spherule -n "__fish_spherule_using_subcommand cases" -l json -d 'Write each case as a line of JSON, numbers as hexadecimal floats, with the true t, instead of files'
complete -c spherule -n "__fish_spherule_using_subcommand cases" -s h -l help -d 'Print help'
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l spheres -d 'Spheres: .npy, float32, (N, 4): centre xyz, radius' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l rays -d 'Rays: .npy, float32, (M, 8): origin xyz, direction xyz, t_min, t_max' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l t -d 'Answers: .npy, float32 or float64, (M,), +inf if a ray has no hit' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l id -d 'The spheres that were answered: .npy, int32, int64 or uint32, (M,), -1 if a ray has no hit' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l family -d 'The family of each ray, as spherule cases writes them: .npy, uint8, (M,)' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l rules -d 'Where the program\'s rules are not Spherule\'s: a .toml file' -r -F
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l again -d 'A command that answers other pairs: it is called with the names of S.npy and R.npy, which it reads, and T.npy, which it writes; so the smallest failures are made smaller' -r
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l pairs -d 'Test ray i against sphere i'
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l json -d 'Report as a JSON object'
complete -c spherule -n "__fish_spherule_using_subcommand judge" -l chart -d 'Show where in each family answers are wrong'
complete -c spherule -n "__fish_spherule_using_subcommand judge" -s h -l help -d 'Print help'
complete -c spherule -n "__fish_spherule_using_subcommand scenes" -s h -l help -d 'Print help'
