// Prints the bunny of the npm package `bunny` as OFF.
const { positions, cells } = require('bunny');

const lines = ['OFF', `${positions.length} ${cells.length} 0`];
for (const position of positions) lines.push(position.join(' '));
for (const cell of cells) lines.push(`3 ${cell.join(' ')}`);
console.log(lines.join('\n'));
