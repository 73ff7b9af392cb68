function D = bihdist(mesh, sources, distance)
% BIHDIST  Distances of all vertices of a mesh from some of them, by the program bihdist.
%
%   D = bihdist('mesh.off', [12 40])             % (n, 2) biharmonic distances from vertices 12 and 40
%   D = bihdist({V, F}, 12)                      % of V (n, 3) and F (m, 3)
%   D = bihdist(mesh, 12, 'diffusion(t=1/4)')    % any distance that bihdist knows
%
% Vertices count from 1, in sources and in F. D is NaN where the distance reaches nothing. Works in Octave, too.
% bihdist has to be on the path of MATLAB's shell: system('bihdist --version') shows whether it is.

if nargin < 3
    distance = 'biharmonic';
end
folder = tempname();
mkdir(folder);
clean = onCleanup(@() remove(folder));
if iscell(mesh)
    file = fullfile(folder, 'mesh.off');
    write_off(file, mesh{1}, mesh{2});
else
    file = mesh;
end
ids = sprintf('%d,', sources(:) - 1);
command = sprintf('bihdist batch "%s" --do fields --sources %s --distance "%s" --format mat --workers 1 -o "%s" 2>&1', ...
    file, ids(1:end - 1), distance, folder);
[status, said] = system(command);
if status ~= 0
    error('bihdist:failed', '%s', strtrim(said));
end
found = dir(fullfile(folder, '*.fields.*.mat'));
result = load(fullfile(folder, found(1).name));
D = result.fields;
end

function write_off(file, V, F)
out = fopen(file, 'w');
fprintf(out, 'OFF\n%d %d 0\n', size(V, 1), size(F, 1));
fprintf(out, '%.17g %.17g %.17g\n', V');
fprintf(out, '3 %d %d %d\n', F' - 1);
fclose(out);
end

function remove(folder)
files = dir(folder);
for k = 1:numel(files)
    if ~files(k).isdir
        delete(fullfile(folder, files(k).name));
    end
end
rmdir(folder);
end
